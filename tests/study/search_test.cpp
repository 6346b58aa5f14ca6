// A study's search as JSON: units carry it, and their fingerprints stand on its every digit.
#include "study/search.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nbvopt/core/error.hpp"
#include "study/unit_message.hpp"
#include "support/error_message.hpp"

namespace nbvopt::study {
namespace {

StudySearch by_solver(const std::string& solver) { return {.search = {.solver = solver}}; }

StudySearch set(StudySearch search, const FieldSetting& setting) {
  set_search(search, setting, "place");
  return search;
}

TEST(StudySearch, IsTheSameJsonAsEver) {
  EXPECT_EQ(to_json(StudySearch{}).dump(),
            R"({"solver":"auto","evaluator":"exact","global":"nlopt:direct-l",)"
            R"("local":"nlopt:lbfgs","polish":"nlopt:cobyla","line_points":15.0,)"
            R"("global_evaluations":20.0,"local_starts":12.0,"start_separation":0.05,)"
            R"("local_tolerance":0.5,"local_evaluations":60.0,"polish_candidates":12.0,)"
            R"("polish_tolerance":0.02,"polish_step":1.0,"polish_evaluations":60.0})");
  EXPECT_EQ(to_json(set({}, {"solver", "grid"})).dump(),
            R"({"solver":"grid","evaluator":"exact","step_pan_rad":0.8,"step_tilt_rad":0.0,)"
            R"("step_height_m":0.0})");
  EXPECT_EQ(to_json(by_solver("ceres:lm")).dump(),
            R"({"solver":"ceres:lm","evaluator":"exact","tolerance":0.005,"initial_step":0.0})");
  EXPECT_EQ(to_json(by_solver("random")).dump(), R"({"solver":"random","evaluator":"exact"})");
}

TEST(StudySearch, ReadsBackWhatItWrites) {
  StudySearch composed{.surrogate_smoothing = 0.5};
  composed.search.stages = StrategyOptions{.global = "", .local_starts = 9};
  StudySearch grid = set(set({}, {"solver", "grid"}), {"step_height_m", 0.05});
  grid.evaluator = "paper-code";
  const StudySearch other = set(by_solver("random"), {"gain", "expected + 2*voxel_weight"});
  EXPECT_EQ(to_json(other).dump(),
            R"({"solver":"random","evaluator":"exact","gain":"expected + 2*voxel_weight"})");
  for (const StudySearch& search :
       {StudySearch{}, composed, grid, by_solver("nlopt:sbplx"), other}) {
    const StudySearch same = search_of(to_json(search));
    EXPECT_EQ(settings(same), settings(search));
    EXPECT_EQ(same.search.solver, search.search.solver);
  }
  EXPECT_EQ(search_of(to_json(composed)).search, composed.search);
  EXPECT_EQ(search_of(to_json(grid)).search, grid.search);
}

TEST(StudySearch, IsTheSameWhetherItsDefaultsAreSaidOrNot) {
  const double starts = StrategyOptions{}.local_starts;
  EXPECT_EQ(settings(set({}, {"local_starts", starts})), settings(StudySearch{}));
  EXPECT_NE(settings(set({}, {"local_starts", starts + 1.0})), settings(StudySearch{}));
}

TEST(StudySearch, RefusesWhatItCannotBeTold) {
  const auto refusal = [](const FieldSetting& setting) {
    return test::message_of<InputError>([&] { set({}, setting); });
  };
  EXPECT_EQ(refusal({"local_start", 5.0}),
            "place: unknown key 'local_start', did you mean 'local_starts'?");
  EXPECT_EQ(refusal({"polish", 5.0}), "place: polish is 5, it must be a word");
  EXPECT_EQ(refusal({"line_points", 1.5}), "place: line_points is 1.5, it must be a whole number");
}

TEST(StudySearch, RefusesParametersThatItsSolverDoesNotHeed) {
  const auto refusal = [](const StudySearch& search, const std::string& key) {
    return test::message_of<InputError>([&] { check_settings(search, {{key, 1.0}}, "place"); });
  };
  EXPECT_EQ(refusal({}, "tolerance"),
            "place: tolerance belongs to solvers nlopt:* and ceres:*, not to auto");
  EXPECT_EQ(refusal(by_solver("nlopt:ags"), "surrogate_smoothing"),
            "place: surrogate_smoothing belongs to solver auto, not to nlopt:ags");
  EXPECT_EQ(refusal(by_solver("nlopt:ags"), "tolerance"), "");
  EXPECT_EQ(refusal(by_solver("nlopt:nothing"), "tolerance"), "") << "refused when it is made";
  StudySearch released = set({}, {"gain", "proximity_count"});
  released.evaluator = "paper-code";
  EXPECT_EQ(refusal(released, "gain"), "place: gain belongs to evaluator exact, not to paper-code");
}

}  // namespace
}  // namespace nbvopt::study
