// The files that explain an answer.
#include <cmath>
#include <sstream>

#include "cli/query_command.hpp"

namespace nbvopt::test {
namespace {

TEST_F(CommandLine, QueryWritesEveryEvaluation) {
  const std::string file = folder / "trace.jsonl";
  const json answer = nbvopt_json(json_query(map_file, {"--solver", "grid", "--trace", file}));
  const std::vector<json> trace = lines_of(file);
  ASSERT_EQ(trace.size(), answer["evaluations"].get<std::size_t>());
  double best = 0.0;
  double time_ms = 0.0;
  for (std::size_t i = 0; i < trace.size(); ++i) {
    EXPECT_EQ(trace[i]["evaluation"], i + 1);
    EXPECT_EQ(trace[i]["kind"], "exact");
    EXPECT_EQ(trace[i]["tilt"], 0.0);
    EXPECT_EQ(trace[i]["height"], 0.4);
    best = std::max(best, trace[i]["gain"].get<double>());
    EXPECT_EQ(trace[i]["best_gain"], best);
    EXPECT_GE(trace[i]["time_ms"], time_ms);
    time_ms = trace[i]["time_ms"];
  }
  EXPECT_EQ(trace.front()["gain"], answer["current_gain"]);
  EXPECT_EQ(best, answer["gain"]);
  EXPECT_LE(time_ms, answer["time_ms"]);
}

TEST_F(CommandLine, QueryTellsTheSurrogatesEvaluationsFromExactOnes) {
  const std::string file = folder / "trace.jsonl";
  const json answer = nbvopt_json(json_query(map_file, {"--solver", "auto", "--trace", file}));
  std::int64_t exact = 0;
  std::int64_t surrogate = 0;
  for (const json& line : lines_of(file)) ++(line["kind"] == "exact" ? exact : surrogate);
  EXPECT_EQ(answer["evaluations"], exact);
  EXPECT_EQ(answer["surrogate_evaluations"], surrogate);
  EXPECT_GT(surrogate, 0);
}

TEST_F(CommandLine, QueryWritesTheLandscape) {
  const std::string file = folder / "landscape.json";
  const json answer =
      nbvopt_json(json_query(map_file, {"--solver", "nlopt:sbplx", "--landscape", file}));
  const json landscape = json::parse(std::ifstream(file));
  EXPECT_EQ(landscape["height"], answer["height"]);
  const std::size_t pans = landscape["pan"].size();
  const std::size_t tilts = landscape["tilt"].size();
  EXPECT_EQ(pans, 64U) << "pi rad in steps of at most 0.05";
  EXPECT_EQ(tilts, 11U) << "half a radian";
  ASSERT_EQ(landscape["gain"].size(), tilts);
  for (const json& row : landscape["gain"]) EXPECT_EQ(row.size(), pans);

  // Its values are those of queries that stay there.
  const auto stay_at = [&](std::size_t pan, std::size_t tilt) {
    return nbvopt_json({"query", map_file, "--base", "0,0,0", "--motion-time", "1e-9", "--pan",
                        landscape["pan"][pan].dump(), "--tilt", landscape["tilt"][tilt].dump(),
                        "--height", landscape["height"].dump(), "--json"})["current_gain"]
        .get<double>();
  };
  EXPECT_NEAR(landscape["gain"][2][50], stay_at(50, 2), 1e-9);
  EXPECT_NEAR(landscape["gain"][9][7], stay_at(7, 9), 1e-9);

  EXPECT_EQ(landscape["start"]["gain"], answer["current_gain"]);
  EXPECT_EQ(landscape["chosen"]["pan"], answer["pan"]);
  EXPECT_EQ(landscape["chosen"]["gain"], answer["gain"]);
  EXPECT_EQ(landscape["candidates"].size(), 4U) << "pi rad in steps of 0.8";
  const json& path = landscape["path"];
  ASSERT_GE(path.size(), 2U);
  EXPECT_EQ(path.front()["gain"], answer["current_gain"]);
  EXPECT_EQ(path.back()["gain"], answer["gain"]);
  for (std::size_t i = 1; i < path.size(); ++i) EXPECT_GT(path[i]["gain"], path[i - 1]["gain"]);
}

TEST_F(CommandLine, QueryWritesTheWholeLandscapeWhateverStopsTheSearch) {
  const std::string file = folder / "landscape.json";
  nbvopt_json(
      json_query(map_file, {"--max-evals", "1", "--time-limit-ms", "1e-6", "--landscape", file}));
  const json landscape = json::parse(std::ifstream(file));
  ASSERT_GT(landscape["tilt"].size(), 1U);
  ASSERT_GT(landscape["pan"].size(), 1U);
  ASSERT_EQ(landscape["gain"].size(), landscape["tilt"].size());
  for (const json& row : landscape["gain"]) {
    EXPECT_EQ(row.size(), landscape["pan"].size());
    for (const json& gain : row) EXPECT_TRUE(gain.is_number());
  }
}

TEST_F(CommandLine, QueryAnswersAlikeWhetherItExplainsOrNot) {
  const json plain = without_times(nbvopt_json(json_query(map_file, {"--solver", "auto"})));
  EXPECT_EQ(without_times(nbvopt_json(json_query(
                map_file, {"--solver", "auto", "--trace", folder / "t.jsonl", "--landscape",
                           folder / "l.json", "--plot", folder / "p.png"}))),
            plain);
}

}  // namespace
}  // namespace nbvopt::test
