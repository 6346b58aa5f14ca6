#include <cmath>
#include <numbers>

#include "cli/query_command.hpp"

namespace nbvopt::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST_F(CommandLine, QueryPrintsOneObjectWithTheDocumentedKeys) {
  const ProcessResult result = nbvopt_run(json_query(map_file, {"--solver", "grid"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const json answer = json::parse(result.out);
  for (const char* key : {"pan",           "tilt",          "height",
                          "gain",          "current_gain",  "status",
                          "message",       "evaluations",   "surrogate_evaluations",
                          "time_ms",       "map_load_ms",   "grid_ms",
                          "solver",        "seed",          "pan_wrapped",
                          "move_time_s",   "evaluator",     "counting",
                          "active_bounds", "warnings",      "pose",
                          "unknown_gain",  "occupied_gain", "unknown_rays",
                          "occupied_rays", "free_rays"}) {
    EXPECT_TRUE(answer.contains(key)) << key;
  }
  EXPECT_EQ(answer["pose"]["position"].size(), 3U);
  EXPECT_EQ(answer["pose"]["orientation_xyzw"].size(), 4U);
  EXPECT_EQ(answer["status"], "grid_complete");
  EXPECT_EQ(answer["solver"], "grid");
  EXPECT_EQ(answer["seed"], 1);
  EXPECT_EQ(answer["evaluator"], "exact");
  EXPECT_EQ(answer["counting"], "per_ray");
  EXPECT_THAT(answer["warnings"], IsEmpty());
}

TEST_F(CommandLine, QueryIsAlgorithmOneOverPan) {
  // Velocity pi rad/s for 0.5 s: pan from -pi/2 to pi/2 in steps of 0.8, and where it stands.
  const json answer = nbvopt_json(json_query(map_file, {"--solver", "grid"}));
  EXPECT_EQ(answer["evaluations"], 5);
  EXPECT_GT(answer["gain"], answer["current_gain"]);
  EXPECT_EQ(answer["tilt"], 0.0);
  EXPECT_EQ(answer["height"], 0.4);
  const double pan = answer["pan"];
  const double steps = (pan + std::numbers::pi / 2) / 0.8;
  EXPECT_NEAR(steps, std::round(steps), 1e-9);
  EXPECT_NEAR(answer["move_time_s"], std::abs(pan) / std::numbers::pi, 1e-12);
  EXPECT_NEAR(answer["gain"],
              answer["unknown_gain"].get<double>() + answer["occupied_gain"].get<double>(), 1e-9);
}

TEST_F(CommandLine, QueryAndEvaluateAgree) {
  const json answer = nbvopt_json(json_query(map_file, {"--tilt", "0.2"}));
  const json file{{"cases", std::vector<json>{answer["pose"],
                                              {{"base", {{"x", 0.0}, {"y", 0.0}, {"yaw", 0.0}}},
                                               {"pan", 0.0},
                                               {"tilt", 0.2},
                                               {"height", 0.4}}}}};
  const json cases = nbvopt_json({"evaluate", map_file, "--poses", "-"}, file.dump())["cases"];
  EXPECT_NEAR(cases.at(0)["gain"], answer["gain"], 1e-6 * answer["gain"].get<double>());
  EXPECT_NEAR(cases.at(1)["gain"], answer["current_gain"], 1e-9);
}

TEST_F(CommandLine, QueryTakesNumbersAndTheMapAsPeopleTypeThem) {
  const json expected =
      without_times(nbvopt_json({"query", map_file, "--base=-1.5,-1,0.25,0.3", "--tilt=-0.2",
                                 "--pan=-0.3", "--motion-time=0.5", "--json"}));
  EXPECT_NE(expected["current_gain"], 0.0);
  const std::vector<Arguments> spellings{
      {"query", "--base", "-1.5,-1,0.25,0.3", "--tilt", "-0.2", "--pan", "-0.3", "--motion-time",
       "0.5", "--json", map_file},
      {"query", "--json", "--pan", "-.3", map_file, "--tilt", "-2e-1", "--base", "-1.5,-1,+.25,.3",
       "--motion-time", "+0.5"},
      {"query", "--pan=-.3", map_file, "--tilt", "-0.20", "--base", "-1.5,-1.0,0.25,0.3",
       "--motion-time", ".5", "--height", "0.18", "--json"}};
  for (const Arguments& spelling : spellings) {
    EXPECT_EQ(without_times(nbvopt_json(spelling)), expected);
  }
}

TEST_F(CommandLine, QueryWithThreeBaseNumbersStandsAtHeightZero) {
  const auto at = [&](const std::string& base) {
    return without_times(
        nbvopt_json({"query", map_file, "--base", base, "--motion-time", "1", "--json"}));
  };
  EXPECT_EQ(at("-0.5,0.5,0.3"), at("-0.5,0.5,0,0.3"));
  EXPECT_NE(at("-0.5,0.5,0.3"), at("-0.5,0.5,0.1,0.3"));
}

TEST_F(CommandLine, QueryAnswersAlikeForAnyNumberOfThreads) {
  const Arguments fine{"--step-pan", "0.05", "--step-tilt", "0.1", "--step-height", "0.03"};
  Arguments one = json_query(map_file, fine);
  one.insert(one.end(), {"--threads", "1"});
  Arguments two = json_query(map_file, fine);
  two.insert(two.end(), {"--threads", "2"});
  EXPECT_EQ(without_times(nbvopt_json(one)), without_times(nbvopt_json(two)));
}

TEST_F(CommandLine, QueryTakesTheExpectedGain) {
  const json positive = nbvopt_json(json_query(map_file));
  const json expected = nbvopt_json(json_query(map_file, {"--gain", "expected"}));
  EXPECT_GT(expected["gain"], 0.0);
  EXPECT_LT(expected["gain"], positive["gain"]);
  EXPECT_EQ(expected["hazards"]["contexts"]["free_frontier"]["metres"], 2.0) << "what ships";
  EXPECT_FALSE(positive.contains("hazards"));
  // The robot's file says so, too, and the command line wins.
  const std::string robot = folder.write("expected.yaml", "sensor:\n  gain: expected\n");
  EXPECT_EQ(nbvopt_json(json_query(map_file, {"--robot", robot}))["gain"], expected["gain"]);
  EXPECT_EQ(nbvopt_json(json_query(map_file, {"--robot", robot, "--gain", "positive"}))["gain"],
            positive["gain"]);
}

TEST_F(CommandLine, QuerySearchesAnyGainExactly) {
  const json area = nbvopt_json(json_query(map_file, {"--gain", "vasquez_gomez_area"}));
  EXPECT_EQ(area["solver"], "nlopt:direct-l");
  EXPECT_NE(area["warnings"].dump().find("no surrogate"), std::string::npos);
  EXPECT_NE(area["status"], "no_gain_in_reach");  // it is never above 2
  EXPECT_GT(area["gain"], area["current_gain"]);
  const json grid = nbvopt_json(
      json_query(map_file, {"--gain", "positive + 2*unobserved_voxel", "--solver", "grid"}));
  EXPECT_GT(grid["gain"], nbvopt_json(json_query(map_file, {"--solver", "grid"}))["gain"]);
}

TEST_F(CommandLine, QueryTellsNoPartsOfAGainThatHasNone) {
  auto arguments = query(map_file);
  EXPECT_THAT(nbvopt_run(arguments).out, HasSubstr("end unknown (gain "));
  arguments.insert(arguments.end(), {"--gain", "unobserved_voxel", "--solver", "grid"});
  EXPECT_THAT(nbvopt_run(arguments).out, HasSubstr("end unknown, "));
}

TEST_F(CommandLine, QueryTellsPeopleWhereToLook) {
  const ProcessResult result = nbvopt_run(query(map_file));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  for (const char* word : {"look", "pan", "tilt", "height", "gain", "staying", "move", "took"}) {
    EXPECT_THAT(result.out, HasSubstr(word));
  }
}

TEST_F(CommandLine, QueryWritesItsAnswerToAFile) {
  const std::string file = folder / "answer.json";
  const json printed = nbvopt_json(json_query(map_file, {"--json-out", file}));
  EXPECT_EQ(json::parse(std::ifstream(file)), printed);
}

TEST_F(CommandLine, QueryDrawsAPicture) {
  const std::string file = folder / "view.png";
  EXPECT_EQ(nbvopt_run(query(map_file, {"--plot", file})).exit_code, 0);
  std::string signature(8, '\0');
  std::ifstream(file, std::ios::binary).read(signature.data(), 8);
  EXPECT_EQ(signature, "\x89PNG\r\n\x1a\n");
}

TEST_F(CommandLine, QueryRefusesOutputFilesBeforeTheSearch) {
  // The map is missing, too: that the output is named shows that it was looked at first.
  for (const char* option : {"--json-out", "--plot", "--trace", "--landscape"}) {
    expect_refusal(nbvopt_run(query("none.ot", {option, folder / "none/x.png"})), 3, "none");
    expect_refusal(nbvopt_run(query("none.ot", {option, "/proc/x.png"})), 3, "/proc/x.png");
    expect_refusal(nbvopt_run(query("none.ot", {option, folder.path()})), 3, "is a folder");
  }
}

TEST_F(CommandLine, QueryMovesJointsALittleIntoTheirLimits) {
  const ProcessResult text = nbvopt_run(query(map_file, {"--tilt", "0.795"}));
  EXPECT_EQ(text.exit_code, 0);
  EXPECT_THAT(text.err, HasSubstr("nbvopt: warning: tilt is 0.795 rad"));

  const ProcessResult machine = nbvopt_run(json_query(map_file, {"--tilt", "0.795"}));
  EXPECT_EQ(machine.err, "");
  const json answer = json::parse(machine.out);
  EXPECT_EQ(answer["tilt"], 0.79);
  ASSERT_EQ(answer["warnings"].size(), 1U);
  EXPECT_THAT(answer["warnings"][0], HasSubstr("tilt is 0.795 rad"));
}

TEST_F(CommandLine, QueryCrossesTheSeamOfAContinuousPan) {
  const json answer = nbvopt_json(json_query(map_file, {"--pan", "3.1"}));
  const double pan = answer["pan"];
  EXPECT_LE(std::abs(pan - 3.1), std::numbers::pi / 2 + 1e-12);
  EXPECT_NEAR(std::remainder(pan - answer["pan_wrapped"].get<double>(), 2 * std::numbers::pi), 0.0,
              1e-12);
  EXPECT_LE(std::abs(answer["pan_wrapped"].get<double>()), std::numbers::pi);
}

TEST_F(CommandLine, QueryWarnsWhereTheMapSaysLittle) {
  const std::string plain = folder / "room.bt";
  write_map(room(), plain, MapFormat::bt);
  const json no_uncertainty = nbvopt_json(json_query(plain));
  EXPECT_THAT(no_uncertainty["warnings"].dump(), HasSubstr("uncertainty"));
  EXPECT_LT(nbvopt_json(json_query(plain, {"--occupied-uncertainty", "0"}))["current_gain"],
            no_uncertainty["current_gain"]);

  UncertaintyMap free_map(0.1);
  free_map.set(free_map.lattice().key({0, 0, 0.4}), {VoxelState::free, -2.0F});
  free_map.finish_writing();
  const std::string free_file = folder / "free.ot";
  write_map(free_map, free_file, MapFormat::uncertainty_ot);
  EXPECT_THAT(nbvopt_json(json_query(free_file))["warnings"].dump(), HasSubstr("occupied"));

  const json outside =
      nbvopt_json({"query", map_file, "--base", "50,0,0", "--motion-time", "1", "--json"});
  EXPECT_THAT(outside["warnings"].dump(), HasSubstr("outside"));
}

TEST_F(CommandLine, QuerySaysWhenNothingIsToBeHad) {
  const json answer = nbvopt_json(json_query(map_file, {"--min-gain", "1e9"}));
  EXPECT_EQ(answer["status"], "no_gain_in_reach");
  EXPECT_EQ(answer["pan"], 0.0);
  EXPECT_EQ(answer["gain"], answer["current_gain"]);
}

TEST_F(CommandLine, QueryStopsAtItsLimits) {
  const json evaluations =
      nbvopt_json(json_query(map_file, {"--solver", "grid", "--max-evals", "2"}));
  EXPECT_EQ(evaluations["status"], "evaluation_limit");
  EXPECT_EQ(evaluations["evaluations"], 2);
  const json time = nbvopt_json(json_query(map_file, {"--time-limit-ms", "1e-6"}));
  EXPECT_EQ(time["status"], "time_limit");
  EXPECT_GE(time["gain"], time["current_gain"]);
}

TEST_F(CommandLine, QueryRunsThePaperCode) {
  const json answer = nbvopt_json(json_query(map_file, {"--evaluator", "paper-code"}));
  EXPECT_EQ(answer["evaluator"], "paper-code");
  EXPECT_GT(answer["gain"], 0.0);
  expect_refusal(
      nbvopt_run(query(map_file, {"--evaluator", "paper-code", "--counting", "per_voxel"})), 2,
      "per_ray only");
}

struct Refusal {
  Arguments arguments;
  int exit_code;
  const char* named;
};

/// Names the case in the test's name.
void PrintTo(const Refusal& refusal, std::ostream* out) {
  for (const std::string& argument : refusal.arguments) *out << argument << ' ';
}

class QueryRefuses : public CommandLine, public ::testing::WithParamInterface<Refusal> {};

TEST_P(QueryRefuses, InOneLine) {
  // Given twice an option is refused as such: leave out what the case sets.
  Arguments arguments{"query", map_file};
  const Arguments& more = GetParam().arguments;
  for (const auto& [option, value] :
       {std::pair{"--base", "0,0,0"}, std::pair{"--motion-time", "0.5"}}) {
    if (std::find(more.begin(), more.end(), option) == more.end()) {
      arguments.insert(arguments.end(), {option, value});
    }
  }
  arguments.insert(arguments.end(), more.begin(), more.end());
  const std::string file = folder / "answer.json";
  arguments.insert(arguments.end(), {"--json-out", file});
  expect_refusal(nbvopt_run(arguments), GetParam().exit_code, GetParam().named);
  EXPECT_FALSE(std::filesystem::exists(file));
}

INSTANTIATE_TEST_SUITE_P(
    Syntax, QueryRefuses,
    ::testing::Values(
        Refusal{{"--base", "0,0"}, 2, "--base: '0,0' has 2 numbers, write X,Y,YAW"},
        Refusal{{"--base", "0,0,0,0,0"}, 2, "--base: '0,0,0,0,0' has 5 numbers"},
        Refusal{{"--base", "0,0,"}, 2, "--base: '' is not a number"},
        Refusal{{"--base", "0,0,0deg"}, 2, "--base: '0deg' is not a number"},
        Refusal{{"--base", "0 0 0"}, 2, "--base: '0 0 0' is not a number"},
        Refusal{{"--tilt", "up"}, 2, "--tilt: 'up' is not a number"},
        Refusal{{"--pan", "--json"}, 2, "--pan: '--json' is not a number"},
        Refusal{{"--motion-time", "1s"}, 2, "--motion-time: '1s' is not a number"},
        Refusal{{"--max-evals", "1.5"}, 2, "--max-evals: '1.5' is not a whole number"},
        Refusal{{"--pan", "0", "--pan", "1"}, 2, "--pan"},
        Refusal{{"--solver", "magic"}, 2, "solver \"magic\""},
        Refusal{{"--evaluator", "magic"}, 2, "--evaluator"},
        Refusal{{"--base-velocity", "0.1,0"},
                2,
                "--base-velocity: '0.1,0' has 2 numbers, write VX,VY,WZ"},
        Refusal{{"--base-velocity", "fast"}, 2, "'fast' is not a number"},
        Refusal{{"--global", "magic"}, 2, "global stage: solver \"magic\""},
        Refusal{{"--local", "magic"}, 2, "local stage: solver \"magic\""},
        Refusal{{"--polish", "magic"}, 2, "polish stage: solver \"magic\""},
        Refusal{{"--local", ""}, 2, "local stage is empty"},
        Refusal{{"--polish", "grid"}, 2, "polish stage: solver grid"},
        Refusal{{"--global", "none", "--local", "none", "--polish", "none"},
                2,
                "every stage is left out"},
        Refusal{{"--solver", "grid", "--polish", "nlopt:sbplx"}, 2, "solver names a whole search"},
        Refusal{{"--step-pan", "-1"}, 3, "--step-pan"},
        Refusal{{"--time-limit-ms", "1e18"}, 3, "--time-limit-ms"},
        Refusal{{"--certify", "--gap", "1"}, 3, "--gap is 1, it must be a share from 0"},
        Refusal{{"--gap", "0.1"}, 2, "--certify"},
        Refusal{{"--certify", "--evaluator", "paper-code"}, 2, "have a bound"},
        Refusal{{"another.ot"}, 2, "another.ot"}));

INSTANTIATE_TEST_SUITE_P(
    Values, QueryRefuses,
    ::testing::Values(Refusal{{"--base", "nan,0,0"}, 3, "--base is nan"},
                      Refusal{{"--base", "0,inf,0"}, 3, "--base is inf"},
                      Refusal{{"--base", "0,0,-inf"}, 3, "--base is -inf"},
                      Refusal{{"--base", "1e300,0,0"}, 3, "lattice"},
                      Refusal{{"--base-velocity", "nan,0,0"}, 3, "--base-velocity is nan"},
                      Refusal{{"--base-velocity", "0,0,inf"}, 3, "--base-velocity is inf"},
                      Refusal{{"--base-velocity", "1e4,0,0"}, 3, "base_twist"},
                      Refusal{{"--base-velocity", "0,0,-1e4"}, 3, "the base would turn"},
                      Refusal{{"--pan", "nan"}, 3, "--pan is nan"},
                      Refusal{{"--pan", "inf"}, 3, "--pan is inf"},
                      Refusal{{"--tilt", "0.9"}, 3, "tilt is 0.9 rad"},
                      Refusal{{"--tilt", "-0.801"}, 3, "tilt is -0.801 rad"},
                      Refusal{{"--height", "0.1"}, 3, "height is 0.1 m"},
                      Refusal{{"--height", "-0.4"}, 3, "height is -0.4 m"},
                      Refusal{{"--motion-time", "-1"}, 3, "--motion-time is -1 s"},
                      Refusal{{"--motion-time", "-inf"}, 3, "--motion-time is -inf"},
                      Refusal{{"--time-limit-ms", "0"}, 3, "--time-limit-ms is 0"},
                      Refusal{{"--max-evals", "0"}, 3, "--max-evals is 0"},
                      Refusal{{"--seed", "-1"}, 3, "--seed is -1"},
                      Refusal{
                          {"--occupied-uncertainty", "2"}, 3, "sensor.occupied_uncertainty is 2"}));

struct BadMap {
  const char* name;
  const char* content;  ///< null: missing
  const char* named;
};

void PrintTo(const BadMap& map, std::ostream* out) { *out << map.name; }

class QueryRefusesMap : public CommandLine, public ::testing::WithParamInterface<BadMap> {};

TEST_P(QueryRefusesMap, ThatIsNone) {
  const BadMap& map = GetParam();
  if (map.content != nullptr) folder.write(map.name, map.content);
  const ProcessResult result = nbvopt_run(query(folder / map.name, {"--json"}));
  expect_refusal(result, 3, map.name);
  EXPECT_THAT(result.err, HasSubstr(map.named));
}

INSTANTIATE_TEST_SUITE_P(
    Maps, QueryRefusesMap,
    ::testing::Values(BadMap{"missing.ot", nullptr, "No such file"},
                      BadMap{"empty.bt", "", "empty"},
                      BadMap{"random.ot", "\x93\x01\xfe junk \x7f\x80", "random.ot"},
                      BadMap{"unknown.ot",
                             "# Octomap OcTree file\nid StampedOcTree\nsize 1\nres 0.1\ndata\n1234",
                             "StampedOcTree"}));

TEST_F(CommandLine, QueryRefusesATruncatedMap) {
  std::filesystem::resize_file(map_file, std::filesystem::file_size(map_file) / 2);
  expect_refusal(nbvopt_run(query(map_file)), 3, "room.ot");
}

TEST_F(CommandLine, QueryRefusesABadRobot) {
  const auto refuse = [&](const std::string& yaml, const std::string& named) {
    const std::string file = folder.write("robot.yaml", yaml);
    expect_refusal(nbvopt_run(query(map_file, {"--robot", file})), 3, named);
  };
  refuse("mast: {tilt_maximum: 1}", "did you mean 'tilt_max_rad'?");
  refuse("mast: {tilt_max_rad: high}", "mast.tilt_max_rad is 'high', it must be a number");
  refuse("sensor: {horizontal_rays: 0}", "sensor.horizontal_rays is 0");
  refuse("sensor: {range_min_m: 4}", "sensor.range_min_m is 4");
}

}  // namespace
}  // namespace nbvopt::test
