#include "study/spec/spec_file.hpp"

#include <gmock/gmock.h>

#include <set>

#include "nbvopt/core/error.hpp"
#include "study/fingerprints.hpp"
#include "study/study_fixture.hpp"
#include "support/error_message.hpp"

namespace nbvopt::study {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> labels(const Study& study) {
  std::vector<std::string> result;
  for (const NamedSearch& named : study.searches) result.push_back(named.label);
  return result;
}

TEST(SpecFile, DeclaresAProduct) {
  const test::StudyFiles files;
  const Study study = files.read(
      "study: small\n"
      "maps: [cluttered.ot]\n"
      "starts: {sampled: {count: 3}}\n"
      "motion_times_s: [0.5, 1]\n"
      "uncertainty_modes: [distance, both]\n"
      "solvers:\n"
      "  - solver: auto\n"
      "  - {solver: grid, step_pan_rad: [0.8, 0.3], step_tilt_rad: [0.2, 0.1]}\n"
      "  - {name: eager, local_starts: 9, surrogate_smoothing: 0.5}\n"
      "budgets: {time_limits_ms: 5, max_evaluations: [200, 50]}\n"
      "seeds: [1, 2, 3]\n"
      "unit_timeout_s: 2.5\n");
  EXPECT_EQ(study.name, "small");
  EXPECT_THAT(labels(study),
              ElementsAre("auto", "grid, step_pan_rad 0.8, step_tilt_rad 0.2",
                          "grid, step_pan_rad 0.8, step_tilt_rad 0.1",
                          "grid, step_pan_rad 0.3, step_tilt_rad 0.2",
                          "grid, step_pan_rad 0.3, step_tilt_rad 0.1", "eager",
                          "paper, released code, step 0.8 rad", "paper, step 0.8 rad",
                          "paper, step 0.4 rad", "paper, step 0.2 rad"));
  EXPECT_EQ(study.searches[5].search.search.stages->local_starts, 9);
  EXPECT_EQ(study.searches[5].search.surrogate_smoothing, 0.5);
  EXPECT_THAT(study.budgets,
              ElementsAre(Budget{.max_evaluations = 50}, Budget{.max_evaluations = 200},
                          Budget{.time_limit_ms = 5.0}));
  EXPECT_EQ(study.unit_timeout_s, 2.5);
  EXPECT_EQ(case_count(study), 3U * 2U * 2U);
  EXPECT_EQ(unit_count(study), 12U * 10U * 3U * 3U);
}

TEST(SpecFile, AddsThePapersSearchesOnce) {
  const test::StudyFiles files;
  const Study study = files.read(
      "maps: [cluttered.ot]\n"
      "starts: {sampled: {count: 1}}\n"
      "motion_times_s: 1\n"
      "solvers: [{name: mine, solver: grid, step_pan_rad: 0.4}]\n");
  EXPECT_THAT(labels(study), ElementsAre("mine", "paper, released code, step 0.8 rad",
                                         "paper, step 0.8 rad", "paper, step 0.2 rad"));
  EXPECT_EQ(study.searches[1].search.evaluator, "paper-code");
  EXPECT_THAT(study.budgets, ElementsAre(Budget{}));
  EXPECT_THAT(study.seeds, ElementsAre(1U));
}

TEST(SpecFile, FindsMapsByPatternAndLeavesOptionalOnesOut) {
  const test::StudyFiles files;
  files.write_map_file("another.ot", 2);
  const DeclaredStudy declared =
      read_spec(files.write_spec("maps: ['*.ot']\n"
                                 "optional_maps: [elsewhere/*.bt]\n"
                                 "starts: {sampled: {count: 2}}\n"
                                 "motion_times_s: [1]\n"
                                 "solvers: [{solver: auto}]\n"));
  ASSERT_EQ(declared.study.maps.size(), 2U);
  EXPECT_EQ(declared.study.maps[0].name, "another.ot");
  EXPECT_EQ(declared.study.maps[1].name, "cluttered.ot");
  EXPECT_NE(declared.study.maps[0].digest, declared.study.maps[1].digest);
  ASSERT_EQ(declared.remarks.size(), 1U);
  EXPECT_THAT(declared.remarks[0], AllOf(HasSubstr("line 2"), HasSubstr("elsewhere/*.bt")));
}

TEST(SpecFile, ListsStarts) {
  const test::StudyFiles files;
  const Study study = files.read(
      "maps: [cluttered.ot]\n"
      "starts:\n"
      "  listed:\n"
      "    - {base: [0.5, -1, 1.57], pan: 0.1, tilt: -0.2, height: 0.4}\n"
      "    - {map: cluttered.ot, base: [0.5, -1, 0.3, 1.57]}\n"
      "motion_times_s: [1]\n"
      "solvers: [{solver: auto}]\n");
  const Start first{0.5, -1.0, 0.0, 1.57, {0.1, -0.2, 0.4}};
  const Start second{0.5, -1.0, 0.3, 1.57, {0.0, 0.0, 0.18}};
  EXPECT_THAT(study.maps[0].starts, ElementsAre(first, second));
}

TEST(SpecFile, RefusesAMapThatIsNone) {
  const test::StudyFiles files;
  files.folder.write("none.ot", "hello");
  const std::string rest =
      "motion_times_s: [1]\nsolvers: [{solver: auto}]\nmaps: [cluttered.ot, none.ot]\n";
  for (const char* starts : {"{sampled: {count: 1}}", "{listed: [{base: [0, 0, 0]}]}"}) {
    const std::string spec = "starts: " + std::string(starts) + "\n" + rest;
    EXPECT_THAT(test::message_of<InputError>([&] { files.read(spec); }),
                AllOf(HasSubstr("spec.yaml: line 1: starts"), HasSubstr("none.ot")));
  }
}

TEST(SpecFile, RefusesAMapUnderTwoNames) {
  const test::StudyFiles files;
  files.write_map_file("copy.ot", 1);
  EXPECT_THAT(test::message_of<InputError>([&] {
                files.read(
                    "maps: ['*.ot']\nstarts: {sampled: {count: 1}}\nmotion_times_s: [1]\n"
                    "solvers: [{solver: auto}]\n");
              }),
              AllOf(HasSubstr("line 1"), HasSubstr("which is the same map as cluttered.ot")));
}

TEST(SpecFile, TakesAMapWithABracketInItsName) {
  const test::StudyFiles files;
  files.write_map_file("[1].ot", 3);
  const Study study = files.read(
      "maps: ['[1].ot']\nstarts: {sampled: {count: 1}}\nmotion_times_s: [1]\n"
      "solvers: [{solver: auto}]\n");
  EXPECT_EQ(study.maps[0].name, "[1].ot");
}

struct BadSpec {
  const char* what;
  const char* from;  ///< a line of the good spec
  const char* to;    ///< what stands there instead
  const char* message;
};

class BadSpecs : public testing::TestWithParam<BadSpec> {};

TEST_P(BadSpecs, AreRefusedWithLineAndKey) {
  const test::StudyFiles files;
  std::string spec =
      "maps: [cluttered.ot]\n"
      "starts: {sampled: {count: 1}}\n"
      "motion_times_s: [1]\n"
      "solvers:\n"
      "  - solver: auto\n"
      "budgets: {max_evaluations: [100]}\n";
  const std::string from = GetParam().from;
  spec.replace(spec.find(from), from.size(), GetParam().to);
  const std::string message =
      test::message_of<InputError>([&] { read_spec(files.write_spec(spec)); });
  EXPECT_THAT(message, AllOf(HasSubstr("spec.yaml: line "), HasSubstr(GetParam().message)));
}

INSTANTIATE_TEST_SUITE_P(
    All, BadSpecs,
    testing::Values(
        BadSpec{"unknown_key", "motion_times_s", "motion_time_s",
                "line 3: unknown key 'motion_time_s', did you mean 'motion_times_s'?"},
        BadSpec{"key_twice", "motion_times_s: [1]", "motion_times_s: [1]\nmotion_times_s: [2]",
                "line 4: motion_times_s is given twice"},
        BadSpec{"no_value", "motion_times_s: [1]",
                "motion_times_s:", "line 3: motion_times_s has no value"},
        BadSpec{"missing_key", "motion_times_s: [1]\n", "", "motion_times_s is missing"},
        BadSpec{"empty_list", "[1]", "[]", "line 3: motion_times_s is empty"},
        BadSpec{"not_a_number", "[1]", "[fast]", "line 3: motion_times_s is 'fast'"},
        BadSpec{"negative_time", "[1]", "[1, -2]", "line 3: motion_times_s is -2 s"},
        BadSpec{"value_twice", "[1]", "[1, 1]", "line 3: motion_times_s names a value twice"},
        BadSpec{"not_yaml", "[1]", "[1", "not valid YAML"},
        BadSpec{"missing_map", "cluttered.ot", "nowhere.ot", "line 1: maps names no file"},
        BadSpec{"no_maps", "[cluttered.ot]", "[]", "line 1: maps is empty"},
        BadSpec{"no_starts", "count: 1", "count: 0", "line 2: starts.sampled.count is 0"},
        BadSpec{"half_a_start", "count: 1", "count: 1.5", "line 2: starts.sampled.count is 1.5"},
        BadSpec{"no_free_space", "count: 1", "count: 1, base_z_m: 40",
                "line 2: starts.sampled finds no free space in cluttered.ot"},
        BadSpec{"unknown_start_key", "sampled:", "drawn:", "line 2: unknown key 'drawn'"},
        BadSpec{"start_elsewhere", "{sampled: {count: 1}}",
                "{listed: [{map: other.ot, base: [0, 0, 0]}]}", "line 2: starts.listed.map is"},
        BadSpec{"joint_beyond_limits", "{sampled: {count: 1}}",
                "{listed: [{base: [0, 0, 0], tilt: 2}]}", "tilt is 2 rad"},
        BadSpec{"unknown_solver", "solver: auto", "solver: atuo",
                "line 5: solvers: solver \"atuo\" is not known"},
        BadSpec{"unknown_stage", "solver: auto", "polish: nlopt:nothing",
                "line 5: solvers: polish stage: solver \"nlopt:nothing\" is not known"},
        BadSpec{"needs_a_gradient", "solver: auto", "solver: nlopt:lbfgs", "gradient"},
        BadSpec{"polish_needs_a_gradient", "solver: auto", "polish: nlopt:lbfgs", "gradient"},
        BadSpec{"unknown_parameter", "solver: auto", "{solver: auto, local_start: 3}",
                "unknown key 'local_start', did you mean 'local_starts'?"},
        BadSpec{"parameter_of_another", "solver: auto", "{solver: auto, step_pan_rad: 0.3}",
                "step_pan_rad belongs to solver grid, not to auto"},
        BadSpec{"bad_parameter", "solver: auto", "{solver: auto, local_starts: 0}", "local_starts"},
        BadSpec{"bad_smoothing", "solver: auto", "{solver: auto, surrogate_smoothing: 0}",
                "smoothing"},
        BadSpec{"negative_step", "solver: auto", "{solver: grid, step_pan_rad: -1}", "line 5"},
        BadSpec{"unknown_evaluator", "solver: auto", "{solver: grid, evaluator: papercode}",
                "did you mean 'paper-code'?"},
        BadSpec{"search_twice", "- solver: auto", "- solver: auto\n  - solver: auto",
                "line 6: solvers would make a second search named 'auto'"},
        BadSpec{"same_search", "- solver: auto",
                "- solver: auto\n  - {name: other, local_starts: [12, 3]}", "keep one"},
        BadSpec{"not_finite", "solver: auto", "{solver: auto, local: none, local_tolerance: nan}",
                "not finite"},
        BadSpec{"too_many_starts", "count: 1", "count: 1e9",
                "line 2: starts.sampled.count is more"},
        BadSpec{"same_start", "{sampled: {count: 1}}",
                "{listed: [{base: [0, 0, 0]}, {base: [0, 0, 0]}]}", "names a value twice"},
        BadSpec{"endless_time", "max_evaluations: [100]", "time_limits_ms: 1e14",
                "line 6: budgets.time_limits_ms is 1e+14"},
        BadSpec{"no_robot", "motion_times_s: [1]", "motion_times_s: [1]\nrobot: none.yaml",
                "line 4: robot: "},
        BadSpec{"no_budget", "{max_evaluations: [100]}", "{}", "line 6: budgets is empty"},
        BadSpec{"zero_budget", "[100]", "[0]", "line 6: budgets.max_evaluations is 0"},
        BadSpec{"zero_time", "max_evaluations: [100]", "time_limits_ms: 0",
                "line 6: budgets.time_limits_ms is 0"}),
    [](const auto& instance) { return instance.param.what; });

TEST(SpecFile, SamplesTheSameStartsWhateverTheirNumber) {
  const test::StudyFiles files;
  files.write_map_file("crowded.ot", 5, 0.6);
  const std::string rest = "motion_times_s: [1]\nsolvers: [{solver: auto}]\nmaps: [crowded.ot]\n";
  const Study few = files.read("starts: {sampled: {count: 4, seed: 3}}\n" + rest);
  const Study many = files.read("starts: {sampled: {count: 40, seed: 3}}\n" + rest);
  const Study other = files.read("starts: {sampled: {count: 4, seed: 4}}\n" + rest);
  const std::vector<Start>& starts = many.maps[0].starts;
  EXPECT_EQ(few.maps[0].starts, std::vector<Start>(starts.begin(), starts.begin() + 4));
  EXPECT_NE(few.maps[0].starts, other.maps[0].starts);
  const UncertaintyMap map = read_map(few.maps[0].file);
  const Mast mast{MastOptions()};
  for (const Start& start : starts) {
    const Transform T_map_base = base_pose(start.x_m, start.y_m, start.z_m, start.yaw_rad);
    const Transform camera = T_map_base * mast.T_base_sensor(start.joints);
    EXPECT_EQ(map.at(map.lattice().key(camera.translation())).state, VoxelState::free);
    EXPECT_NO_THROW(mast.reachable_box(start.joints, 1.0));
  }
}

TEST(Study, CountsItsUnitsAndTellsThemApart) {
  const test::StudyFiles files;
  files.write_map_file("another.ot", 2);
  const Study study = files.read(
      "maps: ['*.ot']\n"
      "starts: {sampled: {count: 2}}\n"
      "motion_times_s: [0.5, 1]\n"
      "uncertainty_modes: [both, angle]\n"
      "solvers: [{solver: auto}]\n"
      "budgets: {max_evaluations: [10, 20], time_limits_ms: [10]}\n"
      "seeds: [1, 2]\n");
  ASSERT_EQ(unit_count(study), 2U * 2U * 2U * 2U * 5U * 3U * 2U);
  Fingerprints fingerprints(study);
  std::set<std::string> cases;
  std::set<std::string> units;
  std::size_t last_map = 0;
  for (std::size_t i = 0; i < unit_count(study); ++i) {
    const UnitIndex unit = unit_at(study, i);
    const std::size_t map = case_at(study, unit.case_index).map;
    EXPECT_GE(map, last_map) << "a worker would read maps again";
    last_map = map;
    units.insert(fingerprints.of_unit(unit));
    cases.insert(fingerprints.of_case(unit.case_index));
  }
  EXPECT_EQ(units.size(), unit_count(study));
  EXPECT_EQ(cases.size(), case_count(study));
}

TEST(Study, KeepsFingerprintsWhenItGrows) {
  const test::StudyFiles files;
  const Study small = files.read(test::kSmallSpec);
  const Study large = files.read(
      "maps: [cluttered.ot]\n"
      "starts: {sampled: {count: 5, seed: 7}}\n"
      "motion_times_s: [0.5, 1]\n"
      "solvers: [{solver: nlopt:sbplx}, {solver: auto}]\n"
      "budgets: {max_evaluations: [10, 20]}\n");
  const std::string before = Fingerprints(small).of_unit({.budget = 0});
  EXPECT_EQ(Fingerprints(large).of_unit({.search = 1, .budget = 1}), before);
  Study other_robot = small;
  other_robot.robot.sensor.range_max_m = 3.0;
  EXPECT_NE(Fingerprints(other_robot).of_unit({.budget = 0}), before);
}

}  // namespace
}  // namespace nbvopt::study
