#include "sim/exploration/volume/goal_search.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace nbvopt {
namespace {

/// Poses a metre apart along x, from 1 m.
std::vector<Eigen::Vector3d> row(int count) {
  std::vector<Eigen::Vector3d> poses;
  for (int i = 1; i <= count; ++i) poses.emplace_back(i, 0.0, 0.0);
  return poses;
}

class GoalSearch : public testing::Test {
 protected:
  std::vector<ScoredPose> search(int count, std::uint64_t seed = 1) {
    std::mt19937_64 random(seed);
    asked_.clear();
    return best_poses(
        row(count), Eigen::Vector2d::Zero(), rules_,
        [this](const Eigen::Vector3d& pose) {
          asked_.push_back(pose.x());
          return most_m3_ - pose.x();
        },
        random);
  }

  VolumeRules rules_ = rules_of(VolumeExplorer::bai2016);
  double most_m3_ = 1000.0;
  std::vector<double> asked_;
};

TEST_F(GoalSearch, JudgesFifteenByChanceAndThreeByOptimisation) {
  const std::vector<ScoredPose> goals = search(100);
  EXPECT_EQ(goals.size(), 18U);
  EXPECT_EQ(asked_.size(), 18U);
  EXPECT_TRUE(std::ranges::is_sorted(goals, std::ranges::greater{}, &ScoredPose::score));
  // By optimisation they are judged by their information alone, and come first.
  std::vector<double> last_three(asked_.end() - 3, asked_.end());
  std::ranges::sort(last_three);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(goals[i].pose.x(), last_three[i]);
    EXPECT_EQ(goals[i].score, 1000.0 - last_three[i]);
  }
  for (std::size_t i = 3; i < goals.size(); ++i) {
    EXPECT_DOUBLE_EQ(goals[i].score, (1000.0 - goals[i].pose.x()) / goals[i].pose.x());
  }
}

TEST_F(GoalSearch, LooksFirstWhereItKnowsLeast) {
  most_m3_ = 100.0;  // with much more the mean decides
  search(100);
  // Metres from the nearest pose that was judged before: none of the 100 is farther from all.
  double farthest_m = 0.0;
  double chosen_m = 100.0;
  for (const Eigen::Vector3d& pose : row(100)) {
    double nearest_m = 100.0;
    for (int i = 0; i < 15; ++i) nearest_m = std::min(nearest_m, std::abs(asked_[i] - pose.x()));
    farthest_m = std::max(farthest_m, nearest_m);
    if (pose.x() == asked_[15]) chosen_m = nearest_m;
  }
  EXPECT_GT(farthest_m, 5.0);
  EXPECT_GT(chosen_m, 0.6 * farthest_m);
}

TEST_F(GoalSearch, LeavesAFewOutOfASmallFirstBatch) {
  EXPECT_EQ(search(4).size(), 4U);
  EXPECT_EQ(search(10).size(), 10U);
  rules_ = rules_of(VolumeExplorer::tekniker);
  EXPECT_EQ(search(10).size(), 11U);
}

TEST_F(GoalSearch, PrefersTheFarOnesAsReleased) {
  rules_ = rules_of(VolumeExplorer::tekniker);
  const std::vector<ScoredPose> goals = search(40);
  const auto is_first_batch = [](const ScoredPose& goal) {
    return goal.score == 2.0 * (1000.0 - goal.pose.x()) * goal.pose.x();
  };
  EXPECT_EQ(std::ranges::count_if(goals, is_first_batch), 15);
}

TEST_F(GoalSearch, IsDecidedByTheSeed) {
  search(100, 7);
  const std::vector<double> first = asked_;
  search(100, 7);
  EXPECT_EQ(asked_, first);
  search(100, 8);
  EXPECT_NE(asked_, first);
}

}  // namespace
}  // namespace nbvopt
