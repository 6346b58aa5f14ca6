#include "bag/tf_history.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nbvopt {
namespace {

using ::testing::ElementsAre;

/// A robot that drives along x at 1 m/s and turns by 0.2 rad/s, with a camera 0.5 m up.
TfHistory drive() {
  TfHistory tf;
  for (const int i : {2, 0, 1}) tf.add("/map", "base", i, base_pose(i, 0, 0, 0.2 * i), false);
  tf.add("base", "/camera", 0.0, base_pose(0, 0, 0.5, 0), true);
  tf.add("other", "thing", 1.0, base_pose(1, 2, 3, 0), false);
  tf.finish();
  return tf;
}

TEST(TfHistory, IsLinearBetweenTimes) {
  const auto T = drive().look_up("map", "camera", 1.25, 0.0);
  ASSERT_TRUE(T);
  EXPECT_TRUE(T->isApprox(base_pose(1.25, 0, 0.5, 0.25), 1e-12));
  const auto back = drive().look_up("camera", "map", 1.25, 0.0);
  EXPECT_TRUE((*T * *back).isApprox(Transform::Identity(), 1e-12));
  EXPECT_TRUE(drive().look_up("base", "camera", 77.0, 0.0));  // static
}

TEST(TfHistory, EndsWithWhatWasTold) {
  EXPECT_FALSE(drive().look_up("map", "camera", 2.1, 0.05));
  const auto T = drive().look_up("map", "camera", 2.1, 0.15);
  ASSERT_TRUE(T);
  EXPECT_TRUE(T->isApprox(base_pose(2, 0, 0.5, 0.4), 1e-12));
  EXPECT_FALSE(drive().look_up("map", "camera", -0.1, 0.05));
}

TEST(TfHistory, KnowsWhatIsNotConnected) {
  EXPECT_FALSE(drive().look_up("map", "thing", 1.0, 0.0));
  EXPECT_FALSE(drive().look_up("map", "nobody", 1.0, 0.0));
  EXPECT_EQ(drive().root_of("/camera"), "map");
  EXPECT_EQ(drive().root_of("nobody"), "nobody");
  EXPECT_THAT(drive().frames(), ElementsAre("base", "camera", "map", "other", "thing"));
}

TEST(TfHistory, GoesRoundNoCircle) {
  TfHistory tf;
  tf.add("a", "b", 0.0, Transform::Identity(), true);
  tf.add("b", "a", 0.0, Transform::Identity(), true);
  tf.finish();
  EXPECT_FALSE(tf.look_up("map", "a", 0.0, 0.0));
  EXPECT_FALSE(tf.root_of("a").empty());
}

}  // namespace
}  // namespace nbvopt
