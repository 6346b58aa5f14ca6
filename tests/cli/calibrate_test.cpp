// nbvopt calibrate: hazards learnt from drives, as a user types it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "cli/command_line.hpp"
#include "cli/served.hpp"
#include "nbvopt/gain/hazard_file.hpp"

namespace nbvopt {
namespace {

using test::nbvopt_json;
using test::nbvopt_run;
using test::office_world;
using test::TemporaryFolder;
using testing::HasSubstr;

/// Five seconds of standing in the shipped office.
std::string standing_drive(const TemporaryFolder& folder) {
  return folder.write("drive.csv",
                      "time_s,x_m,y_m,z_m,yaw_rad\n0,0.62,0.71,0,0\n5,0.62,0.71,0,0\n");
}

std::vector<std::string> calibrate(const std::string& drive) {
  return {"calibrate", "--drive",    office_world(), drive, "--motion-time",
          "1",         "--no-cache", "--seed",       "1",   "--no-progress"};
}

TEST(Calibrate, LearnsWhatQueryCanUse) {
  const TemporaryFolder folder;
  const std::string hazards = folder / "hazards.json";
  auto arguments = calibrate(standing_drive(folder));
  arguments.insert(arguments.end(), {"--hazards-out", hazards, "--json"});
  const auto json = nbvopt_json(arguments);
  ASSERT_EQ(json["drives"].size(), 1U);
  EXPECT_EQ(json["drives"][0]["world"], office_world());
  EXPECT_GT(json["drives"][0]["learnt"]["contexts"]["unknown_middle_deep"]["metres"], 0.0);
  EXPECT_EQ(nlohmann::json::parse(hazards_json(read_hazards(hazards))), json["hazards"]);

  const auto answer = nbvopt_json({"query", (test::datasets_dir() / "office_partial.ot").string(),
                                   "--base", "1.9,2.6,1.57", "--height", "0.4", "--motion-time",
                                   "0.5", "--gain", "expected", "--hazards", hazards, "--json"});
  EXPECT_EQ(answer["hazards"], json["hazards"]);
}

TEST(Calibrate, TellsPeopleHowGoodItIs) {
  const TemporaryFolder folder;
  const auto run = nbvopt_run(calibrate(standing_drive(folder)));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  for (const char* part : {"from nothing", "from the other worlds", "hits a metre over all drives",
                           "unknown_middle_deep"}) {
    EXPECT_THAT(run.out, HasSubstr(part));
  }
}

TEST(Calibrate, TakesWhatAServerHasLearnt) {
  const test::ServerFolder folder;
  const test::Served served(folder, folder.arguments({"--gain", "expected"}));
  PlannerClient client(folder.socket());
  const Transform T_map_base = base_pose(0.0, 0.0, 0.0, 0.0);
  client.insert_scan(test::small_scan(), T_map_base * test::scan_pose(0));
  const std::string hazards = folder.folder / "hazards.json";
  const auto json =
      nbvopt_json({"calibrate", "--server", folder.socket(), "--hazards-out", hazards, "--json"});
  EXPECT_EQ(nlohmann::json::parse(hazards_json(read_hazards(hazards))), json);
  EXPECT_GT(read_hazards(hazards).total().metres, HazardTable().total().metres);
  EXPECT_EQ(read_hazards(hazards), *client.status().hazards);
  EXPECT_THAT(nbvopt_run({"calibrate", "--server", folder.socket()}).out,
              HasSubstr("unknown_middle_deep: "));
  // Asked by a gain that is not the robot's.
  const auto answer =
      nbvopt_json({"query", "--server", folder.socket(), "--base", "0,0,0", "--height", "0.4",
                   "--motion-time", "0.5", "--gain", "positive", "--json"});
  EXPECT_FALSE(answer.contains("hazards"));
}

TEST(Calibrate, SaysWhenAServerLearnsNothing) {
  const test::ServerFolder folder;
  const test::Served served(folder, folder.arguments({"--gain", "positive"}));
  const auto run = nbvopt_run({"calibrate", "--server", folder.socket()});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("learns no hazards: its gain is not expected"));
  EXPECT_THAT(nbvopt_run({"calibrate"}).err, HasSubstr("--drive for each drive, or a --server"));
}

TEST(Calibrate, RefusesWhatCannotBeReplayed) {
  const TemporaryFolder folder;
  test::expect_refusal(nbvopt_run({"calibrate"}), 2, "--drive");
  test::expect_refusal(nbvopt_run({"calibrate", "--drive", office_world()}), 2, "--drive");
  test::expect_refusal(nbvopt_run(calibrate(folder / "absent.csv")), 3, "absent.csv");
  const std::string bad = folder.write("bad.csv", "time_s,x_m,y_m,z_m,yaw_rad\n0,here,0,0,0\n");
  test::expect_refusal(nbvopt_run(calibrate(bad)), 3, "bad.csv");
  auto arguments = calibrate(standing_drive(folder));
  arguments.insert(arguments.end(), {"--hazards-out", "/absent/hazards.json"});
  test::expect_refusal(nbvopt_run(arguments), 3, "/absent");
  EXPECT_FALSE(std::filesystem::exists(folder / "hazards.json"));
}

}  // namespace
}  // namespace nbvopt
