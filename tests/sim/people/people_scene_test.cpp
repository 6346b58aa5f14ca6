// What rays meet of people.
#include "sim/people/people_scene.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "nbvopt/core/error.hpp"
#include "nbvopt/sim/simulated_camera.hpp"
#include "nbvopt/sim/simulated_lidar.hpp"
#include "sim/box_mesh.hpp"
#include "sim/people/body.hpp"
#include "support/error_message.hpp"
#include "support/numbers.hpp"

namespace nbvopt::test {
namespace {

PeopleScene people_at(std::span<const BodyPose> bodies) {
  PeopleScene people(bodies.size());
  people.place(bodies);
  return people;
}

float distance_m(const PeopleScene& people, const Eigen::Vector3d& origin,
                 const Eigen::Vector3d& direction, float before_m = kInfinity) {
  const Eigen::Vector3f ray = direction.normalized().cast<float>();
  people.shorten(origin, {&ray, 1}, 10.0F, {&before_m, 1});
  return before_m;
}

TEST(PeopleScene, MeetsACapsuleWhereItStands) {
  const BodyPose body{.feet_map_m = {3.0, 1.0, 0.2}};
  const PeopleScene people = people_at({&body, 1});
  for (const double y_m : {0.0, 0.1, -0.2, 0.24}) {  // off the axis
    EXPECT_NEAR(distance_m(people, {0.0, 1.0 + y_m, 1.4}, Eigen::Vector3d::UnitX()),
                3.0 - std::sqrt(0.25 * 0.25 - y_m * y_m), 1e-5);
  }
  EXPECT_EQ(distance_m(people, {0.0, 1.26, 1.4}, Eigen::Vector3d::UnitX()), kInfinity);
  // The head is a half sphere whose centre is 1.45 m above the feet.
  const Eigen::Vector3d to_head(3.0, 1.0, -3.35);
  EXPECT_NEAR(distance_m(people, {0.0, 0.0, 5.0}, to_head), to_head.norm() - 0.25, 1e-5);
  EXPECT_NEAR(distance_m(people, {3.0, 1.0, 5.0}, {1e-3, 0.0, -1.0}), 5.0 - 1.9, 1e-4);
}

TEST(PeopleScene, ShortensOnlyWhatIsLonger) {
  const BodyPose body{.feet_map_m = {3.0, 0.0, 0.0}};
  const PeopleScene people = people_at({&body, 1});
  EXPECT_EQ(distance_m(people, {0.0, 0.0, 1.0}, Eigen::Vector3d::UnitX(), 2.0F), 2.0F);
  EXPECT_NEAR(distance_m(people, {0.0, 0.0, 1.0}, Eigen::Vector3d::UnitX(), 2.9F), 2.75, 1e-5);
  EXPECT_EQ(distance_m(people, {0.0, 0.0, 1.0}, -Eigen::Vector3d::UnitX(), 9.0F), 9.0F);
  EXPECT_EQ(distance_m(people, {-20.0, 0.0, 1.0}, Eigen::Vector3d::UnitX()), kInfinity)
      << "beyond the range";
}

TEST(PeopleScene, FollowsThePeople) {
  std::vector<BodyPose> bodies(2);
  bodies[0].feet_map_m = {3.0, 0.0, 0.0};
  bodies[1].feet_map_m = {0.0, 5.0, 0.0};
  PeopleScene people = people_at(bodies);
  EXPECT_NEAR(distance_m(people, {0.0, 0.0, 1.2}, Eigen::Vector3d::UnitY()), 4.75, 1e-5);
  bodies[1].feet_map_m.y() = 2.0;
  people.place(bodies);
  EXPECT_NEAR(distance_m(people, {0.0, 0.0, 1.2}, Eigen::Vector3d::UnitY()), 1.75, 1e-5);
  EXPECT_NEAR(distance_m(people, {0.0, 0.0, 1.2}, Eigen::Vector3d::UnitX()), 2.75, 1e-5);
  EXPECT_EQ(message_of<UsageError>([&] {
              people.place({bodies.data(), 1});
            }),
            "there are not as many poses as people");
}

TEST(PeopleScene, SwingsTheLegsAlongTheHeading) {
  BodyPose body{.feet_map_m = {3.0, 0.0, 0.0}, .heading_rad = kPi};  // towards the origin
  const auto legs = [&](double walked_m) {
    body.walked_m = walked_m;
    const PeopleScene people = people_at({&body, 1});
    return std::pair(distance_m(people, {0.0, 0.1, 0.12}, Eigen::Vector3d::UnitX()),
                     distance_m(people, {0.0, -0.1, 0.12}, Eigen::Vector3d::UnitX()));
  };
  const auto [left, right] = legs(0.0);
  EXPECT_NEAR(left, right, 1e-5);
  const auto [left_back, right_ahead] = legs(0.25 * 1.3);  // a quarter of a stride
  EXPECT_LT(right_ahead, left_back - 0.1) << "he who looks at us has his left at our right";
  const auto [left_ahead, right_back] = legs(0.75 * 1.3);
  EXPECT_NEAR(left_ahead, right_ahead, 1e-4);
  EXPECT_NEAR(right_back, left_back, 1e-4);
  for (const Capsule& part : body_parts(0.3)) {
    EXPECT_GT(std::min(part.from_m.z(), part.to_m.z()) - part.radius_m, -1e-9) << "on the floor";
  }
}

/// A wall across the x axis.
Scene wall_at(double x_m) {
  TriangleMesh mesh;
  add_box(mesh, {x_m, -9.0, -9.0}, {x_m + 0.1, 9.0, 9.0});
  return Scene(mesh);
}

TEST(PeopleScene, IsSeenByTheCameraAndNotByTheLidar) {
  const Scene scene = wall_at(3.5);
  const BodyPose body{.feet_map_m = {2.0, 0.0, -1.0}};
  const PeopleScene people = people_at({&body, 1});
  SensorOptions sensor;
  sensor.horizontal_pixels = 60;
  sensor.vertical_pixels = 45;
  Transform T_map_sensor = Transform::Identity();
  T_map_sensor.linear() = rotation_body_sensor();
  const auto capture = [&](const PeopleScene* seen) {
    return SimulatedCamera(scene, sensor, 0.0, 1, seen).capture(T_map_sensor, 0);
  };
  int on_the_body = 0;
  for (const Eigen::Vector3f& p_sensor_m : capture(&people).points_m) {
    if (std::abs(p_sensor_m.z() - 3.5F) < 1e-4F) continue;  // of the wall
    const Eigen::Vector3d p_map_m = T_map_sensor * p_sensor_m.cast<double>();
    // From above the hips up to the shoulders the capsule is a cylinder, with nothing before it.
    if (p_map_m.z() < -0.1 || p_map_m.z() > 0.4) continue;
    EXPECT_NEAR((p_map_m.head<2>() - body.feet_map_m.head<2>()).norm(), 0.25, 1e-4);
    ++on_the_body;
  }
  EXPECT_GT(on_the_body, 100);
  for (const Eigen::Vector3f& p_sensor_m : capture(nullptr).points_m) {
    ASSERT_NEAR(p_sensor_m.z(), 3.5F, 1e-4F);
  }
  const std::vector<float> ranges_m = SimulatedLidar(scene, {}).scan(Transform::Identity());
  EXPECT_NEAR(ranges_m[0], 3.5, 1e-5);
}

TEST(PeopleScene, IsTheSameForAnyNumberOfThreads) {
  std::vector<BodyPose> bodies(5);
  std::vector<Eigen::Vector3f> directions;
  for (int i = 0; i < 5; ++i) {
    bodies[i] = {{2.0 * std::cos(i), 2.0 * std::sin(i), -0.5}, 0.7 * i, 0.2 * i};
  }
  for (int i = 0; i < 20'000; ++i) {
    directions.push_back(
        Eigen::Vector3f(std::cos(0.1F * i), std::sin(0.1F * i), 1e-4F * (i - 10'000)).normalized());
  }
  const PeopleScene people = people_at(bodies);
  const auto cast = [&](int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    std::vector<float> distances(directions.size(), kInfinity);
    people.shorten({0.1, 0.0, 0.0}, directions, 8.0F, distances);
    return distances;
  };
  EXPECT_EQ(cast(1), cast(8));
}

}  // namespace
}  // namespace nbvopt::test
