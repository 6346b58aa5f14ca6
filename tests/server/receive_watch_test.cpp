// Messages that are late, and the memory of those that have come.
#include "server/receive_watch.hpp"

#include <gtest/gtest.h>

#include <atomic>

#include "server/limits.hpp"
#include "support/wait_until.hpp"

namespace nbvopt {
namespace {

using namespace std::chrono_literals;

struct Call final : ReceivingCall {
  void end_late() override { is_late = true; }
  std::atomic<bool> is_late{false};
};

TEST(ReceiveWatch, EndsWhatIsLateAndNothingElse) {
  ReceiveWatch watch(50ms);
  Call received;
  Call late;
  watch.add(received);
  EXPECT_TRUE(watch.remove(received));
  watch.add(late);
  EXPECT_TRUE(test::wait_until([&] { return late.is_late.load(); }));
  EXPECT_FALSE(watch.remove(late));
  EXPECT_FALSE(received.is_late);
}

TEST(ReceiveWatch, LeavesThoseAloneThatHaveTime) {
  Call call;
  {
    ReceiveWatch watch(1h);
    watch.add(call);
  }
  EXPECT_FALSE(call.is_late);
}

TEST(MessageMemory, IsGivenBackWithTheMessage) {
  MessageMemory memory(1);
  constexpr std::size_t kHalf = 1 << 19;
  const MessageMemory::Share first(memory, kHalf);
  EXPECT_TRUE(first.is_granted());
  {
    const MessageMemory::Share second(memory, kHalf);
    EXPECT_TRUE(second.is_granted());
    const MessageMemory::Share third(memory, 1);
    EXPECT_FALSE(third.is_granted());
  }
  const MessageMemory::Share fourth(memory, kHalf);
  EXPECT_TRUE(fourth.is_granted());
}

TEST(MessageMemory, IsEnoughForOneMessageHoweverLarge) {
  MessageMemory memory(1);
  const MessageMemory::Share large(memory, 1 << 24);
  EXPECT_TRUE(large.is_granted());
}

}  // namespace
}  // namespace nbvopt
