// Localisation along a drive: how far the base is from where it believes to be.
#include "sim/localisation/localiser.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <iostream>
#include <limits>
#include <vector>

#include "nbvopt/core/error.hpp"
#include "sim/slam/ring.hpp"
#include "support/error_message.hpp"

namespace nbvopt::test {
namespace {

using testing::HasSubstr;

/// A lidar that is quick to match.
LocalisationOptions coarse_options(PoseSource source) {
  LocalisationOptions options{.source = source};
  options.lidar.beams = 360;
  return options;
}

/// A drive's poses every half second.
struct Localised {
  std::vector<BasePoses> poses;
  LocalisationRecord record;
};

Localised localise(const Trajectory& drive, const LocalisationOptions& options,
                   std::uint64_t seed = 1) {
  const Scene scene(ring_mesh());
  Localiser localiser(scene, drive, options, seed);
  Localised result;
  for (int i = 0; 0.5 * i <= drive.duration_s(); ++i) {
    result.poses.push_back(localiser.at(0.5 * i));
  }
  result.record = localiser.record();
  return result;
}

/// The first seconds of a drive.
Trajectory beginning_of(const Trajectory& drive, double duration_s) {
  std::vector<TrajectoryPoint> points;
  for (const TrajectoryPoint& point : drive.points()) {
    if (point.time_s <= duration_s) points.push_back(point);
  }
  return Trajectory(points);
}

TEST(Localiser, KnowsTheTruthToTheBit) {
  const Trajectory drive = ring_drive();
  LocalisationOptions options;
  options.odometry_noise = 5.0;  // of wheels that nobody asks
  const Localised localised = localise(drive, options);
  for (std::size_t i = 0; i < localised.poses.size(); ++i) {
    const Transform T_world_base = drive.T_map_base(0.5 * static_cast<double>(i));
    EXPECT_EQ(localised.poses[i].T_map_base.matrix(), T_world_base.matrix());
    EXPECT_EQ(localised.poses[i].T_world_base.matrix(), T_world_base.matrix());
  }
  EXPECT_EQ(localised.record.captures.largest_m, 0.0);
}

TEST(Localiser, DriftsByOdometryAndHoldsItsCourseBySlam) {
  const LocalisationRecord odom = localise(ring_drive(), coarse_options(PoseSource::odom)).record;
  const LocalisationRecord slam = localise(ring_drive(), coarse_options(PoseSource::slam)).record;
  std::cout << "odom: off by " << odom.captures.mean_m << " m on average, at most "
            << odom.captures.largest_m << "; slam: " << slam.captures.mean_m << ", "
            << slam.captures.largest_m << ", after scans " << slam.scans.mean_m << ", "
            << slam.scans.largest_m << '\n';
  EXPECT_GT(odom.captures.largest_m, 1.0);
  EXPECT_LT(slam.captures.mean_m, 0.1 * odom.captures.mean_m);
  EXPECT_LT(slam.captures.largest_m, 0.1 * odom.captures.largest_m);
  EXPECT_LT(slam.captures.largest_m, 0.1);
  EXPECT_LT(slam.scans.largest_m, 0.1);
  EXPECT_GT(slam.scan_count, 40U);
  EXPECT_EQ(odom.scan_count, 0U);
}

TEST(Localiser, GoesByWhatPeopleLeaveToSee) {
  const Trajectory drive = beginning_of(ring_drive(), 20.0);
  const Localised alone = localise(drive, coarse_options(PoseSource::slam));
  LocalisationOptions among = coarse_options(PoseSource::slam);
  among.people.persons = {{.name = "somebody", .position_map_m = {-2.0, -2.8, 0.0}}};
  const Localised beside = localise(drive, among);
  EXPECT_NE(alone.poses.back().T_map_base.matrix(), beside.poses.back().T_map_base.matrix());
  EXPECT_LT(beside.record.scans.largest_m, 0.2) << "they hide walls, and are no walls";
  among.source = PoseSource::odom;
  EXPECT_EQ(localise(drive, among).poses.back().T_map_base.matrix(),
            localise(drive, coarse_options(PoseSource::odom)).poses.back().T_map_base.matrix());
}

TEST(Localiser, ReportsDistancesInThePlane) {
  const Trajectory drive = beginning_of(ring_drive(), 10.0);
  const Localised odom = localise(drive, coarse_options(PoseSource::odom));
  std::vector<double> errors_m;
  double sum_m = 0.0;
  for (const BasePoses& base : odom.poses) {
    const Eigen::Vector3d error_m = base.T_map_base.translation() - base.T_world_base.translation();
    EXPECT_EQ(error_m.z(), 0.0);
    errors_m.push_back(error_m.head<2>().norm());
    sum_m += errors_m.back();
  }
  EXPECT_NEAR(odom.record.captures.mean_m, sum_m / static_cast<double>(errors_m.size()), 1e-12);
  EXPECT_NEAR(odom.record.captures.largest_m, *std::ranges::max_element(errors_m), 1e-12);
  EXPECT_NEAR(odom.record.captures.end_m, errors_m.back(), 1e-12);
}

TEST(Localiser, StartsWhereItIs) {
  for (const PoseSource source : {PoseSource::odom, PoseSource::slam}) {
    const Scene scene(ring_mesh());
    const Trajectory drive = ring_drive();
    Localiser localiser(scene, drive, coarse_options(source), 1);
    const BasePoses base = localiser.at(0.0);
    EXPECT_TRUE(base.T_map_base.isApprox(base.T_world_base, 1e-12));
  }
}

/// The base knows how it will drive, but not that it is elsewhere.
TEST(Localiser, LooksAheadFromWhereItBelievesToBe) {
  const Scene scene(ring_mesh());
  const Trajectory drive = ring_drive();
  Localiser localiser(scene, drive, coarse_options(PoseSource::odom), 1);
  const BasePoses now = localiser.at(9.0);
  const BasePoses ahead = localiser.ahead(9.5);
  EXPECT_EQ(ahead.T_world_base.matrix(), drive.T_map_base(9.5).matrix());
  EXPECT_TRUE((now.T_map_base.inverse() * ahead.T_map_base)
                  .isApprox(now.T_world_base.inverse() * ahead.T_world_base, 1e-9));
  EXPECT_TRUE(localiser.ahead(9.0).T_map_base.isApprox(now.T_map_base, 1e-9));
}

TEST(Localiser, IsTheSamePerSeedForAnyNumberOfThreads) {
  const Trajectory drive = beginning_of(ring_drive(), 20.0);
  const LocalisationOptions options = coarse_options(PoseSource::slam);
  const auto end = [&](std::size_t threads, std::uint64_t seed) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return Eigen::Matrix4d(localise(drive, options, seed).poses.back().T_map_base.matrix());
  };
  const Eigen::Matrix4d once = end(1, 1);
  EXPECT_EQ(once, end(4, 1));
  EXPECT_NE(once, end(4, 2));
}

TEST(Localiser, IsExactWithWheelsThatAre) {
  const Trajectory drive = beginning_of(ring_drive(), 15.0);
  LocalisationOptions options = coarse_options(PoseSource::odom);
  options.odometry_noise = 0.0;
  EXPECT_LT(localise(drive, options).record.captures.largest_m, 1e-9);
  options.source = PoseSource::slam;
  EXPECT_LT(localise(drive, options).record.captures.largest_m, 0.03);
}

TEST(Localiser, RefusesWhatCannotBe) {
  const auto refusal = [](auto change) {
    LocalisationOptions options{.source = PoseSource::odom};
    change(options);
    return message_of<InputError>([&] { localise(ring_drive(), options); });
  };
  EXPECT_EQ(refusal([](auto& options) { options.odometry_noise = -0.5; }),
            "odometry_noise is -0.5, it must be 0 or more and finite");
  EXPECT_THAT(refusal([](auto& options) {
                options.odometry_noise = std::numeric_limits<double>::infinity();
              }),
              HasSubstr("odometry_noise is inf"));
  EXPECT_EQ(refusal([](auto& options) { options.lidar_range_m = 101.0; }),
            "lidar_range_m is 101, it must be positive and at most the lidar's range of 100 m");
  EXPECT_THAT(refusal([](auto& options) { options.lidar.beams = 0; }), HasSubstr("lidar.beams"));
}

TEST(Localiser, RefusesSlamWithNothingInSight) {
  TriangleMesh mesh;
  add_box(mesh, {-30.0, -30.0, -0.03}, {30.0, 30.0, 2.5});
  const Scene scene(mesh);
  const Trajectory drive = ring_drive();
  const auto refusal = [&](double range_m) {
    LocalisationOptions options = coarse_options(PoseSource::slam);
    options.lidar_range_m = range_m;
    return message_of<InputError>([&] { const Localiser localiser(scene, drive, options, 1); });
  };
  EXPECT_EQ(refusal(4.0),
            "slam: the lidar sees nothing within 4 m of where the drive starts, so that there is "
            "nothing to go by: start near walls, or use the pose source odom or truth");
  EXPECT_EQ(refusal(40.0), "");
}

}  // namespace
}  // namespace nbvopt::test
