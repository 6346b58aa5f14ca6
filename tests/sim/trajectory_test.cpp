#include "nbvopt/sim/trajectory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "nbvopt/core/error.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt {
namespace {

using testing::HasSubstr;

/// A file of this process, since tests run side by side.
std::filesystem::path file(const std::string& name) {
  static const test::TemporaryFolder folder;
  return folder / (name + ".csv");
}

/// What reading a file of this text complains about.
std::string complaint(const std::string& text) {
  const std::filesystem::path path = file("bad");
  std::ofstream(path) << text;
  try {
    read_trajectory(path);
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(path.string()));
    return error.what();
  }
  return "read without complaint";
}

constexpr const char* kHeader = "time_s,x_m,y_m,z_m,yaw_rad\n";

TEST(Trajectory, IsLinearBetweenPointsAndStandsBeyondThem) {
  const Trajectory trajectory({{0.0, 0.0, 0.0, 0.5, 0.0}, {2.0, 3.0, 4.0, 0.5, 7.0}});
  EXPECT_EQ(trajectory.duration_s(), 2.0);
  EXPECT_EQ(trajectory.length_m(), 5.0);
  EXPECT_TRUE(trajectory.T_map_base(1.0).isApprox(base_pose(1.5, 2.0, 0.5, 3.5), 1e-12));
  EXPECT_TRUE(trajectory.T_map_base(0.0).isApprox(base_pose(0.0, 0.0, 0.5, 0.0), 1e-12));
  EXPECT_TRUE(trajectory.T_map_base(-1.0).isApprox(base_pose(0.0, 0.0, 0.5, 0.0), 1e-12));
  EXPECT_TRUE(trajectory.T_map_base(2.0).isApprox(base_pose(3.0, 4.0, 0.5, 7.0), 1e-12));
  EXPECT_TRUE(trajectory.T_map_base(9.0).isApprox(base_pose(3.0, 4.0, 0.5, 7.0), 1e-12));
}

TEST(Trajectory, GoesOnToLaterPointsOnly) {
  Trajectory trajectory({{0.0, 0.0, 0.0, 0.5, 0.0}});
  trajectory.append({2.0, 3.0, 4.0, 0.5, 7.0});
  EXPECT_TRUE(trajectory.T_map_base(1.0).isApprox(base_pose(1.5, 2.0, 0.5, 3.5), 1e-12));
  EXPECT_THROW(trajectory.append({2.0, 3.0, 4.0, 0.5, 7.0}), InputError);
  EXPECT_THROW(trajectory.append({3.0, std::nan(""), 4.0, 0.5, 7.0}), InputError);
  EXPECT_EQ(trajectory.points().size(), 2U);
}

TEST(Trajectory, MayBeASinglePoint) {
  const Trajectory trajectory({{0.0, 1.0, 2.0, 0.0, 0.5}});
  EXPECT_EQ(trajectory.duration_s(), 0.0);
  EXPECT_EQ(trajectory.length_m(), 0.0);
  EXPECT_TRUE(trajectory.T_map_base(3.0).isApprox(base_pose(1.0, 2.0, 0.0, 0.5), 1e-12));
}

TEST(Trajectory, RefusesWhatIsNone) {
  EXPECT_THROW(Trajectory(std::vector<TrajectoryPoint>{}), InputError);
  EXPECT_THROW(Trajectory({{1.0, 0.0, 0.0, 0.0, 0.0}}), InputError) << "starts late";
  EXPECT_THROW(Trajectory({{0.0, 0.0, 0.0, 0.0, 0.0}, {0.0, 1.0, 0.0, 0.0, 0.0}}), InputError);
  EXPECT_THROW(Trajectory({{0.0, std::nan(""), 0.0, 0.0, 0.0}}), InputError);
  EXPECT_THROW(Trajectory({{0.0, 0.0, 0.0, 0.0, 0.0},
                           {std::numeric_limits<double>::infinity(), 0.0, 0.0, 0.0, 0.0}}),
               InputError);
}

TEST(TrajectoryFile, KeepsEveryBit) {
  std::vector<TrajectoryPoint> points;
  for (int i = 0; i < 200; ++i) {
    points.push_back({i / 20.0, std::sin(i) * 1e3, -1.0 / (i + 3), i * 1e-17, std::exp(0.1 * i)});
  }
  const Trajectory trajectory(points);
  write_trajectory(trajectory, file("exact"));
  EXPECT_EQ(read_trajectory(file("exact")).points(), trajectory.points());
}

TEST(TrajectoryFile, MayComeFromAnotherSystem) {
  std::ofstream(file("crlf")) << "time_s,x_m,y_m,z_m,yaw_rad\r\n0,1,2,3,4\r\n0.5,1,2,3,+4";
  const Trajectory trajectory = read_trajectory(file("crlf"));
  ASSERT_EQ(trajectory.points().size(), 2U);
  EXPECT_EQ(trajectory.points()[1], (TrajectoryPoint{0.5, 1.0, 2.0, 3.0, 4.0}));
}

TEST(TrajectoryFile, NamesTheLineAndTheFault) {
  EXPECT_THAT(complaint("x,y\n0,0\n"), HasSubstr("line 1: is not the header"));
  EXPECT_THAT(complaint(kHeader), HasSubstr("at least one point"));
  const std::string start = kHeader + std::string("0,0,0,0,0\n");
  EXPECT_THAT(complaint(start + "1,2,3,4\n"), HasSubstr("line 3: has 4 values, it must have 5"));
  EXPECT_THAT(complaint(start + "1,2,3,4,5,6\n"), HasSubstr("line 3: has 6 values"));
  EXPECT_THAT(complaint(start + "1,2,north,4,5\n"),
              HasSubstr("line 3: y_m is 'north', it must be a number"));
  EXPECT_THAT(complaint(start + "1,2,,4,5\n"), HasSubstr("line 3: y_m is ''"));
  EXPECT_THAT(complaint(start + "1,2,inf,4,5\n"), HasSubstr("line 3: y_m is inf"));
  EXPECT_THAT(complaint(start + "1,0,0,0,0\n1,0,0,0,0\n"),
              HasSubstr("line 4: time_s is 1 after 1, times must grow"));
  EXPECT_THAT(complaint(kHeader + std::string("0.5,0,0,0,0\n")), HasSubstr("must start at 0"));
  EXPECT_THAT(complaint(start + "\n1,0,0,0,0\n"), HasSubstr("line 3: has 1 values"));
}

TEST(TrajectoryFile, NamesAFileThatIsNotThere) {
  EXPECT_THROW(read_trajectory(file("missing")), InputError);
  EXPECT_THROW(write_trajectory(Trajectory({TrajectoryPoint{}}), "/no/such/folder/drive.csv"),
               InputError);
}

}  // namespace
}  // namespace nbvopt
