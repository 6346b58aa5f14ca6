#include "server/work_queue.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <latch>
#include <string>
#include <vector>

namespace nbvopt {
namespace {

TEST(WorkQueue, DoesAllThatItTookInOrder) {
  std::vector<int> done;
  int taken = 0;
  {
    WorkQueue queue(1, 1000);
    for (int i = 0; i < 100; ++i) {
      if (queue.try_post([&done, i] { done.push_back(i); })) ++taken;
    }
  }
  EXPECT_EQ(taken, 100);
  ASSERT_EQ(done.size(), 100U);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(done[static_cast<std::size_t>(i)], i);
}

TEST(WorkQueue, RefusesWhatExceedsItsPlaces) {
  std::latch started(2);
  std::latch go(1);
  std::atomic<int> done{0};
  {
    WorkQueue queue(2, 3);
    const auto wait = [&] {
      started.count_down();
      go.wait();
      ++done;
    };
    while (!queue.try_post(wait)) {
    }
    while (!queue.try_post(wait)) {
    }
    started.wait();  // both threads are busy: three places are left
    const auto count = [&] { ++done; };
    EXPECT_TRUE(queue.try_post(count));
    EXPECT_TRUE(queue.try_post(count));
    EXPECT_TRUE(queue.try_post(count));
    EXPECT_FALSE(queue.try_post(count));
    go.count_down();
  }
  EXPECT_EQ(done, 5);
}

/// A queue whose only thread is busy until it is let go.
class BusyQueue {
 public:
  explicit BusyQueue(std::size_t max_waiting) : queue(1, max_waiting) {
    queue.try_post([this] {
      started_.count_down();
      go_.wait();
    });
    started_.wait();
  }
  ~BusyQueue() { go_.count_down(); }

 private:
  std::latch started_{1};
  std::latch go_{1};

 public:
  WorkQueue queue;
};

TEST(WorkQueue, LetsClientsTakeTurns) {
  std::string done;
  {
    BusyQueue busy(20);
    for (const char* name : {"a", "a", "a", "a", "b", "b", "c"}) {
      EXPECT_TRUE(busy.queue.try_post([&done, name] { done += name; }, name));
    }
  }
  EXPECT_EQ(done, "abcabaa");
}

TEST(WorkQueue, HasPlacesForEachClient) {
  BusyQueue busy(2);
  const auto nothing = [] {};
  EXPECT_TRUE(busy.queue.try_post(nothing, "many"));
  EXPECT_TRUE(busy.queue.try_post(nothing, "many"));
  EXPECT_FALSE(busy.queue.try_post(nothing, "many"));
  EXPECT_TRUE(busy.queue.try_post(nothing, "other"));
}

TEST(WorkQueue, TakesWorkFromManyThreads) {
  std::atomic<int> done{0};
  std::atomic<int> taken{0};
  {
    WorkQueue queue(3, 16);
    std::vector<std::thread> posters;
    for (int i = 0; i < 4; ++i) {
      posters.emplace_back([&] {
        for (int j = 0; j < 1000; ++j) {
          if (queue.try_post([&] { ++done; })) ++taken;
        }
      });
    }
    for (std::thread& poster : posters) poster.join();
  }
  EXPECT_EQ(done, taken);
  EXPECT_GT(done, 0);
}

}  // namespace
}  // namespace nbvopt
