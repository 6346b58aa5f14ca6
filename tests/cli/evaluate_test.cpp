#include <cmath>

#include "cli/command_line.hpp"
#include "nbvopt/gain/view_evaluator.hpp"
#include "nbvopt/mast/mast.hpp"
#include "support/oracle.hpp"
#include "support/paths.hpp"

namespace nbvopt::test {
namespace {

using nlohmann::json;

/// The optical frame at (0, 0, z), looking along the map's x axis, down along -z.
json view_along_x(double z) {
  return {{"position", {0.0, 0.0, z}}, {"orientation_xyzw", {-0.5, 0.5, -0.5, 0.5}}};
}

json one_ray_sensor() { return {{"horizontal_rays", 1}, {"vertical_rays", 1}}; }

std::string poses(const std::vector<json>& cases, const json& sensor = json::object()) {
  return json{{"sensor", sensor}, {"cases", cases}}.dump();
}

TEST_F(CommandLine, EvaluateGivesEquation12OfOneRay) {
  const json answer = nbvopt_json({"evaluate", map_file, "--poses", "-"},
                                  poses({view_along_x(0.75)}, one_ray_sensor()));
  // The wall's face is 1.9 m away, straight ahead: u_d = 1 - 2 / (1 + e^0.9), u_alpha = 0.
  const double u_new = 0.5 * (1.0 - 2.0 / (1.0 + std::exp(0.9)));
  ASSERT_EQ(answer["cases"].size(), 1U);
  EXPECT_NEAR(answer["cases"][0]["gain"], double{0.8F} - u_new, 1e-9);
  EXPECT_EQ(answer["cases"][0]["unknown_rays"], 0);
  EXPECT_EQ(answer["cases"][0]["occupied_rays"], 1);
  EXPECT_EQ(answer["cases"][0]["free_rays"], 0);
  EXPECT_EQ(answer["evaluator"], "exact");
  EXPECT_EQ(answer["counting"], "per_ray");
  EXPECT_EQ(answer["map"], map_file);
}

TEST_F(CommandLine, EvaluateKeepsTheOrderOfTheCases) {
  const json base_case{{"base", {{"x", 0.0}, {"y", 0.0}, {"yaw", 0.0}}},
                       {"pan", 0.0},
                       {"tilt", 0.0},
                       {"height", 0.75}};
  const json above{{"position", {0.0, 0.0, 5.0}}, {"orientation_xyzw", {1.0, 0.0, 0.0, 0.0}}};
  const json cases = nbvopt_json({"evaluate", "--poses", "-", map_file},
                                 poses({above, view_along_x(0.75), base_case}))["cases"];
  ASSERT_EQ(cases.size(), 3U);
  EXPECT_EQ(cases[0]["unknown_rays"], 48 * 36);  // nothing is known up there
  EXPECT_GT(cases[1]["occupied_rays"], 0);
  EXPECT_EQ(cases[1], cases[2]);  // the same view, told in two ways
}

TEST_F(CommandLine, EvaluateReadsFilesAndAnswersAlikeForAnyNumberOfThreads) {
  const std::string file = folder.write("poses.json", poses({view_along_x(0.3), view_along_x(1)}));
  const json one = nbvopt_json({"evaluate", map_file, "--poses", file, "--threads", "1"});
  const json two = nbvopt_json({"evaluate", map_file, "--poses", file, "--threads=2", "--json"});
  EXPECT_EQ(one["cases"], two["cases"]);
}

TEST_F(CommandLine, EvaluateCountsPerVoxelWhenAsked) {
  const std::string input = poses({view_along_x(0.75)});
  const json per_ray = nbvopt_json({"evaluate", map_file, "--poses", "-"}, input);
  const json per_voxel =
      nbvopt_json({"evaluate", map_file, "--poses", "-", "--counting", "per_voxel"}, input);
  EXPECT_EQ(per_voxel["counting"], "per_voxel");
  EXPECT_LT(per_voxel["cases"][0]["gain"], per_ray["cases"][0]["gain"]);
  EXPECT_GT(per_voxel["cases"][0]["gain"], 0.0);
}

TEST_F(CommandLine, EvaluateLetsTheCommandLineWinOverTheFile) {
  const std::string input = poses({view_along_x(0.75)}, {{"counting", "per_voxel"}});
  EXPECT_EQ(nbvopt_json({"evaluate", map_file, "--poses", "-"}, input)["counting"], "per_voxel");
  EXPECT_EQ(nbvopt_json({"evaluate", map_file, "--poses", "-", "--counting", "per_ray"},
                        input)["counting"],
            "per_ray");
}

TEST_F(CommandLine, EvaluateTakesTheRobotsSensor) {
  const std::string robot = folder.write("robot.yaml", "sensor: {horizontal_rays: 5}\n");
  const json answer = nbvopt_json({"evaluate", map_file, "--poses", "-", "--robot", robot},
                                  poses({view_along_x(5.0)}));
  EXPECT_EQ(answer["cases"][0]["unknown_rays"], 5 * 36);
}

TEST_F(CommandLine, EvaluateRunsThePaperCodeOnItsOwnSensor) {
  const json answer =
      nbvopt_json({"evaluate", map_file, "--poses", "-", "--evaluator", "paper-code"},
                  poses({view_along_x(0.75)}));
  const UncertaintyMap map = room();
  const ViewGain expected = make_paper_code_evaluator(map, paper_code_sensor({}))
                                ->evaluate(Mast({}).T_base_sensor({0.0, 0.0, 0.75}));
  EXPECT_EQ(answer["evaluator"], "paper-code");
  EXPECT_NEAR(answer["cases"][0]["gain"], expected.gain, 1e-9);
  EXPECT_EQ(answer["cases"][0]["unknown_rays"], expected.unknown_rays);
}

TEST_F(CommandLine, EvaluateOfNoCasesAnswersWithNone) {
  EXPECT_EQ(nbvopt_json({"evaluate", map_file, "--poses", "-"}, R"({"cases": []})")["cases"],
            json::array());
}

TEST_F(CommandLine, EvaluateRefusesWhatItCannotUse) {
  const auto refuse = [&](const std::string& input, const std::string& named) {
    expect_refusal(nbvopt_run({"evaluate", map_file, "--poses", "-"}, input), 3, named);
  };
  refuse("", "standard input");
  refuse("{\"cases\":\n[{]}", "standard input: line 2");
  refuse(R"({"cases": [{"position": [0, 0, NaN], "orientation_xyzw": [0, 0, 0, 1]}]})", "line 1");
  refuse(R"({"cases": [{"position": [0, 0, 0], "orientation_xyzw": [0, 0, 0, 0]}]})", "cases[0]");
  refuse(R"({"cases": [{"position": [0, 0, 1e300], "orientation_xyzw": [0, 0, 0, 1]}]})",
         "cases[0]: the camera is off the map's lattice");
  refuse(poses({}, {{"vertical_rays", 0}}), "sensor.vertical_rays is 0");
  refuse(poses({}, {{"range_min_m", 4.5}}), "sensor.range_min_m is 4.5");
  refuse(poses({}, {{"rangemax_m", 4.5}}), "did you mean 'range_max_m'?");

  expect_refusal(nbvopt_run({"evaluate", map_file, "--poses", folder / "none.json"}), 3,
                 "none.json");
  expect_refusal(nbvopt_run({"evaluate", map_file, "--poses", folder.path().string()}), 3,
                 "is a folder");
}

TEST_F(CommandLine, EvaluateRefusesWrongOptions) {
  const auto refuse = [&](const std::vector<std::string>& options, int code,
                          const std::string& named) {
    std::vector<std::string> arguments{"evaluate", map_file, "--poses", "-"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    expect_refusal(nbvopt_run(arguments, R"({"cases": []})"), code, named);
  };
  refuse({"--evaluator", "guess"}, 2, "--evaluator");
  refuse({"--counting", "per_pixel"}, 2, "--counting");
  refuse({"--evaluator", "paper-code", "--counting", "per_voxel"}, 2, "per_ray only");
  refuse({"--threads", "two"}, 2, "--threads: 'two' is not a whole number");
  refuse({"--threads", "-1"}, 3, "--threads is -1");
  refuse({"--threads", "99999999999"}, 3, "--threads is 99999999999");
  refuse({"--robot", folder / "none.yaml"}, 3, "none.yaml");
}

// The recorded answers of the paper authors' own map class, and those derived for the map that
// ships.

class RecordedGains : public ::testing::TestWithParam<const char*> {};

TEST_P(RecordedGains, AreReproducedByThePaperCode) {
  const std::string file = GetParam();
  NBVOPT_REQUIRE_ORACLE(file);
  const json oracle = read_oracle(file);
  const json& recorded = oracle.at("cases");
  const json found = nbvopt_json({"evaluate", oracle_map_file(oracle), "--poses", oracle_file(file),
                                  "--evaluator", "paper-code"})["cases"];
  ASSERT_EQ(found.size(), recorded.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double gain = recorded[i]["gain"];
    EXPECT_NEAR(found[i]["gain"], gain, std::max(0.5, 1e-3 * gain)) << i;
    EXPECT_EQ(found[i]["unknown_rays"], recorded[i]["unknown_rays"]) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Oracle, RecordedGains,
                         ::testing::Values("ASLAM_lab.json", "apartment_partial.json",
                                           "warehouse_partial.json", "office_partial.json"));

}  // namespace
}  // namespace nbvopt::test
