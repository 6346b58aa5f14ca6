// How a query searches, and on what base.
#include "cli/query_command.hpp"
#include "nbvopt/solver/strategy.hpp"

namespace nbvopt::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(CommandLine, QueryHasADefaultSolver) {
  EXPECT_EQ(nbvopt_json(json_query(map_file))["solver"], "auto");
}

TEST_F(CommandLine, QueryRunsTheStrategyByName) {
  const json answer = nbvopt_json(json_query(map_file, {"--solver", "auto"}));
  EXPECT_EQ(answer["solver"], "auto");
  EXPECT_GT(answer["surrogate_evaluations"], 0);
  EXPECT_GE(answer["gain"], nbvopt_json(json_query(map_file, {"--solver", "grid"}))["gain"])
      << "three joints do better than one";
}

TEST_F(CommandLine, QueryComposesASearchFromItsStages) {
  const auto solver_of = [&](const Arguments& stages) {
    return nbvopt_json(json_query(map_file, stages))["solver"].get<std::string>();
  };
  const StrategyOptions stages;  // those that are not given are the strategy's own
  EXPECT_EQ(solver_of({"--global", "nlopt:crs2"}),
            "nlopt:crs2 + " + stages.local + " + " + stages.polish);
  EXPECT_EQ(solver_of({"--local", "nlopt:slsqp"}),
            stages.global + " + nlopt:slsqp + " + stages.polish);
  EXPECT_EQ(solver_of({"--polish", "nlopt:bobyqa"}),
            stages.global + " + " + stages.local + " + nlopt:bobyqa");
  EXPECT_EQ(solver_of({"--global", "none", "--polish", "none"}), stages.local);
}

TEST_F(CommandLine, QueryLeavesTheSurrogateOutWhereOnlyThePolishRuns) {
  const json answer = nbvopt_json(
      json_query(map_file, {"--global", "none", "--local", "none", "--polish", "nlopt:sbplx"}));
  EXPECT_EQ(answer["surrogate_evaluations"], 0);
  EXPECT_GT(answer["evaluations"], 1);
  EXPECT_GE(answer["gain"], answer["current_gain"]);
}

TEST_F(CommandLine, QueryStaysForTooLittleGainUnlessItsOwnLimitsCutTheSearchShort) {
  const Arguments search{"--solver", "nlopt:direct-l", "--min-gain", "1e6"};
  const json whole = nbvopt_json(json_query(map_file, search));
  EXPECT_EQ(whole["status"], "no_gain_in_reach") << "whatever the solver's own limit says";
  EXPECT_EQ(whole["gain"], whole["current_gain"]);
  Arguments limited = search;
  limited.insert(limited.end(), {"--max-evals", "10"});
  EXPECT_EQ(nbvopt_json(json_query(map_file, limited))["status"], "evaluation_limit");
}

TEST_F(CommandLine, QueryProvesHowMuchABetterViewCouldAdd) {
  const json plain = nbvopt_json(json_query(map_file));
  EXPECT_FALSE(plain.contains("upper_bound"));
  const json proved = nbvopt_json(json_query(map_file, {"--certify", "--gap", "0.2"}));
  EXPECT_EQ(proved["status"], "certified");
  EXPECT_GE(proved["gain"], plain["gain"]);
  EXPECT_GE(proved["upper_bound"], proved["gain"]);
  EXPECT_LE(proved["gap"], 0.2);
  const json at_once =
      nbvopt_json(json_query(map_file, {"--certify", "--gap", "0", "--time-limit-ms", "1e-6"}));
  EXPECT_NE(at_once["status"], "certified");
  EXPECT_GE(at_once["upper_bound"], proved["gain"]);
}

TEST_F(CommandLine, QuerySaysWhereAMovingBaseWillBe) {
  const json answer = nbvopt_json(json_query(map_file, {"--base-velocity", "0.2,-0.1,0"}));
  const double time_s = answer["move_time_s"];
  ASSERT_GT(time_s, 0.0);
  const json& base = answer["base_on_arrival"];
  EXPECT_NEAR(base["x"], 0.2 * time_s, 1e-12);
  EXPECT_NEAR(base["y"], -0.1 * time_s, 1e-12);
  EXPECT_EQ(base["z"], 0.0);
  EXPECT_EQ(base["yaw"], 0.0);
  EXPECT_NEAR(answer["pose"]["position"][0], base["x"], 1e-12);

  const ProcessResult text = nbvopt_run(query(map_file, {"--base-velocity", "0.2,-0.1,0"}));
  EXPECT_THAT(text.out, HasSubstr("\nbase    at "));
}

TEST_F(CommandLine, QuerySaysNothingOfABaseAtRest) {
  const json rest = nbvopt_json(json_query(map_file, {"--base-velocity", "0,0,0"}));
  EXPECT_FALSE(rest.contains("base_on_arrival"));
  EXPECT_EQ(without_times(rest), without_times(nbvopt_json(json_query(map_file))));
  EXPECT_THAT(nbvopt_run(query(map_file)).out, Not(HasSubstr("\nbase ")));
}

}  // namespace
}  // namespace nbvopt::test
