// nbvopt robot show, and URDF wherever a command takes a robot.
#include "nbvopt/planner/robot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "cli/query_command.hpp"
#include "core/text_file.hpp"

namespace nbvopt::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

const Arguments kCamera{"--camera-link", "camera_depth_optical_frame"};

std::string shipped_robot(const std::string& file) {
  return (datasets_dir() / "robots" / file).string();
}

Arguments joined(Arguments arguments, const Arguments& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST_F(CommandLine, QueryAnswersAUrdfAsTheYamlByHand) {
  const json paper = without_times(nbvopt_json(json_query(map_file)));
  const Arguments lift = joined({"--robot", shipped_robot("lift.urdf")}, kCamera);
  EXPECT_EQ(without_times(nbvopt_json(json_query(map_file, lift))), paper);

  const std::string by_hand =
      folder.write("hand.yaml",
                   "mast:\n  pan_continuous: false\n  pan_min_rad: -2.6\n  pan_max_rad: 2.6\n"
                   "  pan_velocity_rad_s: 1.5\n  tilt_min_rad: -1.1\n  tilt_max_rad: 0.5\n"
                   "  tilt_velocity_rad_s: 0.8\n  height_min_m: 0.47\n  height_max_m: 0.47\n"
                   "  pan_axis_x_m: -0.05\n"
                   "  sensor_offset_m: [0.04, 0.0175, 0.025]\n");
  const Arguments situation{"query", map_file, "--base", "0,0,0", "--motion-time", "0.5", "--json"};
  const Arguments turtle = joined({"--robot", shipped_robot("turtle_pan_tilt.urdf")}, kCamera);
  const json answer = without_times(nbvopt_json(joined(situation, turtle)));
  EXPECT_EQ(answer, without_times(nbvopt_json(joined(situation, {"--robot", by_hand}))));
  EXPECT_NE(answer["gain"], paper["gain"]);
}

TEST_F(CommandLine, RobotShowTellsWhatAUrdfSaysAndWritesIt) {
  const std::string yaml = folder / "turtle.yaml";
  const ProcessResult shown = nbvopt_run(
      joined({"robot", "show", shipped_robot("turtle_pan_tilt.urdf"), "-o", yaml}, kCamera));
  EXPECT_EQ(shown.exit_code, 0) << shown.err;
  EXPECT_EQ(shown.err, "");
  EXPECT_THAT(
      shown.out,
      AllOf(
          StartsWith("robot   turtle_pan_tilt, from base_footprint to camera_depth_optical_frame, "
                     "whose axes are optical"),
          HasSubstr("pan     -2.6 to 2.6 rad, at most 1.5 rad/s: pan = head_pan_joint\n"),
          HasSubstr("tilt    -1.1 to 0.5 rad, at most 0.8 rad/s: tilt = -head_tilt_joint\n"),
          HasSubstr("height  0.47 m, fixed\n"),
          HasSubstr("axis    the pan axis stands at x, y = -0.05, 0 m of the base\n"),
          HasSubstr("offset  0.04, 0.0175, 0.025 m")));
  const Robot direct =
      read_robot(shipped_robot("turtle_pan_tilt.urdf"), {}, {"camera_depth_optical_frame", "", {}});
  EXPECT_EQ(read_robot(yaml), direct);

  const ProcessResult lift =
      nbvopt_run(joined({"robot", "show", shipped_robot("lift.urdf")}, kCamera));
  EXPECT_THAT(lift.out, AllOf(HasSubstr("pan     without end, at most 3.14"),
                              HasSubstr("height = 0.18 + 3 * lift_1_joint\n")));
  const ProcessResult paper = nbvopt_run({"robot", "show", shipped_robot("paper.yaml")});
  EXPECT_THAT(paper.out, AllOf(StartsWith("pan     without end"),
                               HasSubstr("height  0.18 to 0.63 m, at most 0.15 m/s\n")));
}

TEST_F(CommandLine, RobotShowWarnsOnStandardErrorAlone) {
  const std::string still =
      folder.write("still.urdf",
                   "<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='fixed'>"
                   "<parent link='a'/><child link='b'/></joint></robot>");
  const ProcessResult shown = nbvopt_run({"robot", "show", still, "--camera-link", "b"});
  EXPECT_EQ(shown.exit_code, 0);
  EXPECT_EQ(shown.err,
            "nbvopt: warning: " + still +
                ": no joint between 'a' and 'b' moves, so that there is one view only\n");
}

TEST_F(CommandLine, RobotsThatCannotBeUsedAreRefused) {
  const std::string turtle = shipped_robot("turtle_pan_tilt.urdf");
  expect_refusal(nbvopt_run(query(map_file, {"--robot", turtle})), 3, "give camera_link");
  expect_refusal(nbvopt_run(query(map_file, {"--robot", turtle, "--camera-link", "camera"})), 3,
                 "did you mean 'camera_link'?");
  expect_refusal(nbvopt_run(query(map_file, kCamera)), 2, "name it by --robot");
  expect_refusal(
      nbvopt_run(query(map_file, joined({"--robot", shipped_robot("paper.yaml")}, kCamera))), 3,
      "paper.yaml: is no URDF");
  expect_refusal(nbvopt_run(query(map_file, {"--robot", turtle, "--camera-axes", "up"})), 2,
                 "--camera-axes");
  const std::string kept = folder.write("kept.yaml", "mine");
  expect_refusal(nbvopt_run({"robot", "show", turtle, "-o", kept}), 3, "give camera_link");
  EXPECT_EQ(read_text_file(kept), "mine");
  expect_refusal(nbvopt_run(joined({"robot", "show", turtle, "-o", folder / "no/r.yaml"}, kCamera)),
                 3, "r.yaml");
  expect_refusal(nbvopt_run({"robot", "show", folder / "none.urdf"}), 3, "none.urdf");
}

}  // namespace
}  // namespace nbvopt::test
