// nbvopt world, and what simulate makes of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "cli/command_line.hpp"

namespace nbvopt {
namespace {

using test::nbvopt_json;
using test::nbvopt_run;
using test::office_world;
using test::TemporaryFolder;
using testing::HasSubstr;

std::string world_of_box(const std::string& size, const std::string& more = "") {
  return "<sdf version='1.6'><world name='w'><model name='m'><link name='l'><visual name='v'>"
         "<geometry><box><size>" +
         size + "</size></box></geometry></visual></link></model>" + more + "</world></sdf>";
}

TEST(WorldInfo, TakesAMeshAloneInItsUnit) {
  const TemporaryFolder folder;
  const std::string mesh =
      folder.write("a.off", "OFF\n3 1 0\n0 0 0\n0 2500 0\n5000 0 1000\n3 0 1 2\n");
  const auto info = nbvopt_json({"world", "info", mesh, "--unit", "mm", "--no-cache", "--json"});
  EXPECT_NEAR(info["extent_m"]["max"][0].get<double>(), 5.0, 1e-6);
  test::expect_refusal(nbvopt_run({"world", "info", mesh, "--unit", "yard"}), 2, "mm");
}

TEST(WorldInfo, TellsExtentFloorsTrianglesAndStarts) {
  const auto info = nbvopt_json({"world", "info", office_world(), "--no-cache", "--json"});
  EXPECT_EQ(info["models"], 1);
  EXPECT_EQ(info["triangles"], 2196);
  EXPECT_EQ(info["missing"].size(), 0U);
  EXPECT_NEAR(info["extent_m"]["max"][0].get<double>(), 8.1, 1e-6);
  ASSERT_GE(info["floors"].size(), 1U);
  EXPECT_NEAR(info["floors"][0]["height_m"].get<double>(), 0.0, 1e-3);
  ASSERT_GE(info["starts"].size(), 1U);
  EXPECT_EQ(info["starts"][0]["pose"][2], 0.0);
  const auto text = nbvopt_run({"world", "info", office_world(), "--no-cache"});
  EXPECT_EQ(text.exit_code, 0);
  EXPECT_THAT(text.out, HasSubstr("extent: 8.20 x 6.20 x 2.80 m"));
  EXPECT_THAT(text.out, HasSubstr("missing: nothing"));
  EXPECT_THAT(text.out, HasSubstr("start: "));
}

TEST(WorldInfo, ListsPlacesFromWhichSimulateStarts) {
  const auto info = nbvopt_json({"world", "info", office_world(), "--no-cache", "--json"});
  const auto run = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"simulate", office_world(), "--no-cache", "--no-progress",
                               "--explore-only", "--duration-max", "0.1", "--json"});
    return nbvopt_run(more);
  };
  for (const auto& start : info["starts"]) {
    std::string numbers;
    for (const double number : start["pose"]) {
      numbers += (numbers.empty() ? "" : ",") + std::to_string(number);
    }
    EXPECT_EQ(run({"--start", numbers}).exit_code, 0) << numbers;
  }
  const auto first = run({});
  EXPECT_EQ(first.exit_code, 0);
  EXPECT_THAT(first.err, HasSubstr("nbvopt: starts at "));
  EXPECT_EQ(nlohmann::json::parse(first.out)["start"], info["starts"][0]["pose"]);
}

TEST(WorldInfo, ListsWhatIsMissing) {
  const TemporaryFolder folder;
  const std::string world = folder.write(
      "a.world", world_of_box("9 9 0.1", "<include><uri>model://absent</uri></include>"));
  const auto info = nbvopt_json({"world", "info", world, "--no-cache", "--json"});
  ASSERT_EQ(info["missing"].size(), 1U);
  EXPECT_THAT(info["missing"][0].get<std::string>(), HasSubstr("model://absent"));
  EXPECT_EQ(nbvopt_run({"world", "info", world, "--no-cache", "--strict"}).exit_code, 3);
}

TEST(WorldInfo, SaysWhereNobodyCanStart) {
  const TemporaryFolder folder;
  const std::string world = folder.write("crate.world", world_of_box("0.2 0.2 0.2"));
  EXPECT_THAT(nbvopt_run({"world", "info", world, "--no-cache"}).out, HasSubstr("nowhere is room"));
  test::expect_refusal(nbvopt_run({"simulate", world, "--no-cache", "--explore-only"}), 3,
                       "no place in the world where the base could start");
}

TEST(Region, IsARectangleOrAFile) {
  const TemporaryFolder folder;
  const auto explore = [&](const std::string& region) {
    return nbvopt_run({"simulate", office_world(), "--no-cache", "--no-progress", "--explore-only",
                       "--duration-max", "0.1", "--start", "0.617,0.713,0", "--region", region});
  };
  EXPECT_EQ(explore("0,0,2,2").exit_code, 0);
  EXPECT_EQ(explore(folder.write("room.csv", "# a corner a line\n0,0\n2 0\n\n0, 2\n")).exit_code,
            0);
  test::expect_refusal(explore("3,3,5,5"), 3, "lies outside of the region");
  test::expect_refusal(explore("0,0,2"), 2, "X0,Y0,X1,Y1");
  test::expect_refusal(explore(folder / "none"), 3, "none");
  test::expect_refusal(explore(folder.write("bad.csv", "0,0\n1,x\n")), 3, "bad.csv: line 2");
  test::expect_refusal(explore(folder.write("two.csv", "0,0\n1,1\n")), 3, "3 corners or more");
}

TEST(OpenGround, EndsAnExplorationThatSaysSo) {
  const TemporaryFolder folder;
  const std::string world = folder.write(
      "hut.world", world_of_box("1 1 2",
                                "<model name='g'><link name='l'><visual name='v'><geometry><plane>"
                                "<size>100 100</size></plane></geometry></visual></link></model>"));
  const std::vector<std::string> explore{
      "simulate",       world,     "--no-cache", "--no-progress", "--json",
      "--explore-only", "--start", "2,0,0",      "--lidar-range", "2",
      "--duration-max", "300"};
  const auto run = nbvopt_run(explore);
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(nlohmann::json::parse(run.out)["status"], "open_ground");
  EXPECT_THAT(run.err, HasSubstr("only open ground is left"));
  std::vector<std::string> on = explore;
  on.push_back("--open-ground");
  EXPECT_EQ(nbvopt_json(on)["status"], "time_limit");
}

}  // namespace
}  // namespace nbvopt
