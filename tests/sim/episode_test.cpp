// Episodes in a room: what is captured when, what is moved where, and what it brings.
#include "nbvopt/sim/episode.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <iostream>
#include <map>
#include <span>
#include <vector>

#include "core/text_file.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/map_file.hpp"
#include "sim/room.hpp"
#include "support/error_message.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt::test {
namespace {

/// An episode and all that it left behind.
struct FinishedEpisode {
  UncertaintyMap map{0.1};
  std::vector<Capture> captures;
  EpisodeSummary summary;
};

EpisodeOptions coarse_options(double motion_time_s = 0.5) {
  EpisodeOptions options;
  options.robot = coarse_robot();
  options.motion_time_s = motion_time_s;
  return options;
}

FinishedEpisode run(const std::string& mode, const EpisodeOptions& options) {
  const Scene scene(room_mesh());
  FinishedEpisode run;
  run.summary = run_episode(scene, straight_drive(), *make_camera_mode(mode), options, run.map,
                            [&](const Capture& capture) { run.captures.push_back(capture); });
  return run;
}

TEST(Episode, CapturesOnceEachMotionTimeInEveryMode) {
  for (const std::string& mode : camera_mode_names()) {
    const FinishedEpisode episode = run(mode, coarse_options());
    ASSERT_EQ(episode.captures.size(), 21U) << mode;
    EXPECT_EQ(episode.summary.captures, 21U) << mode;
    for (std::size_t i = 0; i < episode.captures.size(); ++i) {
      const Capture& capture = episode.captures[i];
      EXPECT_EQ(capture.frame, i);
      EXPECT_EQ(capture.time_s, 0.5 * static_cast<double>(i)) << mode;
      EXPECT_NEAR(capture.T_map_base.translation().x(), -2.0 + 0.2 * capture.time_s, 1e-9);
      EXPECT_FALSE(capture.is_on_the_way);
    }
    EXPECT_EQ(episode.summary.duration_s, 10.0);
  }
}

TEST(Episode, KeepsTheStillCameraStill) {
  const FinishedEpisode episode = run("static", coarse_options());
  ASSERT_EQ(episode.captures.size(), 21U);
  for (const Capture& capture : episode.captures) {
    EXPECT_EQ(capture.joints, EpisodeOptions{}.start_joints);
    EXPECT_TRUE(std::isnan(capture.predicted_gain));
    EXPECT_EQ(capture.motion_time_s, 0.0);
  }
  EXPECT_EQ(episode.summary.prediction.steps, 0U);
}

TEST(Episode, MovesJointsWithinTheirReach) {
  for (const std::string& mode : camera_mode_names()) {
    const EpisodeOptions options = coarse_options();
    const Mast mast(options.robot.mast);
    const FinishedEpisode episode = run(mode, options);
    for (std::size_t i = 1; i < episode.captures.size(); ++i) {
      const JointBox box =
          mast.reachable_box(episode.captures[i - 1].joints, options.motion_time_s);
      EXPECT_TRUE(box.contains(episode.captures[i].joints.vector())) << mode << ' ' << i;
      EXPECT_LE(episode.captures[i - 1].motion_time_s, options.motion_time_s + 1e-9);
    }
  }
}

TEST(Episode, TurnsThePanOnlyInThePapersMode) {
  int turns = 0;
  for (const Capture& capture : run("grid", coarse_options()).captures) {
    EXPECT_EQ(capture.joints.tilt_rad, 0.0);
    EXPECT_EQ(capture.joints.height_m, 0.4);
    if (capture.joints.pan_rad != 0.0) ++turns;
  }
  EXPECT_GT(turns, 0);
}

TEST(Episode, LearnsMoreTheMoreItSearches) {
  std::map<std::string, double> information;
  for (const std::string& mode : camera_mode_names()) {
    information[mode] = run(mode, coarse_options()).summary.information;
    std::cout << mode << ": information " << information[mode] << '\n';
  }
  EXPECT_GT(information["grid"], 1.2 * information["static"]);
  EXPECT_GT(information["grid-3"], information["grid"]);
  EXPECT_GT(information["auto"], information["grid"]);
  EXPECT_GT(information["auto"], information["random"]);
  EXPECT_GT(information["oracle"], information["grid"]) << "one view at a time, yet it cheats";
}

TEST(Episode, RealisesExactlyWhatTheOracleSaw) {
  const FinishedEpisode episode = run("oracle", coarse_options());
  ASSERT_GT(episode.captures.size(), 2U);
  for (const Capture& capture : std::span(episode.captures).subspan(1)) {
    EXPECT_EQ(capture.predicted_gain, capture.realised_gain) << "the same pose, the same map";
  }
}

TEST(Episode, ReportsItsGrowth) {
  const FinishedEpisode episode = run("auto", coarse_options());
  const auto& points = episode.summary.growth.points();
  ASSERT_EQ(points.size(), episode.captures.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(points[i].time_s, episode.captures[i].time_s);
    EXPECT_EQ(points[i].information, episode.captures[i].information);
  }
}

/// Keeps the camera where it is, and what it was asked and told.
class WatchingMode : public CameraMode {
 public:
  NextView next_view(const ViewPlanner& planner, const PlanRequest& request,
                     const TrueGain& /*true_gain*/) const override {
    requests.push_back(request);
    hazards.push_back(planner.hazards());
    const Transform T = T_map_sensor(request, planner.mast(), request.joints);
    return {.joints = request.joints, .predicted_gain = planner.evaluate(T).gain};
  }
  mutable std::vector<PlanRequest> requests;
  mutable std::vector<HazardTable> hazards;
};

TEST(Episode, PlansAnExpectedGainWhereTheBaseWillBe) {
  for (const GainKind gain : {GainKind::positive, GainKind::expected}) {
    EpisodeOptions options = coarse_options();
    options.robot.sensor.gain = gain;
    const Scene scene(room_mesh());
    const WatchingMode mode;
    UncertaintyMap map(0.1);
    std::vector<Capture> captures;
    run_episode(scene, straight_drive(), mode, options, map,
                [&](const Capture& capture) { captures.push_back(capture); });
    for (std::size_t i = 0; i + 1 < captures.size(); ++i) {
      const Capture& of_base = captures[gain == GainKind::expected ? i + 1 : i];
      EXPECT_TRUE(mode.requests[i].T_map_base.isApprox(of_base.T_map_base)) << i;
      EXPECT_EQ(mode.hazards[i] != HazardTable(), gain == GainKind::expected) << i;
    }
  }
}

TEST(Episode, PredictsAnExpectedGainBetter) {
  EpisodeOptions options = coarse_options();
  const PredictionRecord positive = run("auto", options).summary.prediction;
  options.robot.sensor.gain = GainKind::expected;
  const PredictionRecord expected = run("auto", options).summary.prediction;
  EXPECT_LT(std::abs(expected.bias()), 0.25);
  EXPECT_LT(std::abs(expected.bias()), 0.5 * std::abs(positive.bias()));
  EXPECT_GT(expected.correlation(), positive.correlation());
}

TEST(Episode, PredictsNothingByGainsOfOtherUnits) {
  EpisodeOptions options = coarse_options();
  options.robot.sensor.gain = GainKind::unobserved_voxel;
  EXPECT_EQ(run("grid", options).summary.prediction.steps, 0U);
}

TEST(Episode, CountsWhatIsInTheMap) {
  const FinishedEpisode episode = run("auto", coarse_options());
  const MapCounts counts = episode.map.counts();
  EXPECT_EQ(episode.summary.voxels, counts.certain_voxels);
  EXPECT_NEAR(episode.summary.information, counts.information, 1e-6);
  EXPECT_EQ(episode.captures.back().voxels, counts.certain_voxels);
  double sum = 0.0;
  for (const Capture& capture : episode.captures) sum += capture.information_gain;
  EXPECT_NEAR(sum, counts.information, 1e-6);
}

TEST(Episode, GoesOnWithAMapThatKnowsSomething) {
  FinishedEpisode first = run("static", coarse_options());
  const double known = first.summary.information;
  const Scene scene(room_mesh());
  const EpisodeSummary second = run_episode(scene, straight_drive(), *make_camera_mode("static"),
                                            coarse_options(), first.map, [](const Capture&) {});
  // All is seen again from where it was seen before.
  EXPECT_GE(second.information, known);
  EXPECT_LT(second.information, 1.01 * known);
}

TEST(Episode, PredictsWhatItRealisesWhereAllIsInView) {
  const FinishedEpisode episode = run("auto", coarse_options());
  const PredictionRecord& prediction = episode.summary.prediction;
  EXPECT_EQ(prediction.steps, 20U) << "every capture but the first";
  EXPECT_GT(prediction.correlation(), 0.3);
  EXPECT_GT(prediction.bias(), 0.0) << "not all that is unknown is occupied";
  std::cout << "correlation " << prediction.correlation() << ", bias " << prediction.bias() << '\n';
}

TEST(Episode, CapturesWhileJointsMoveWhenAskedTo) {
  EpisodeOptions options = coarse_options(1.0);
  options.capture_hz = 4.0;
  const Mast mast(options.robot.mast);
  const FinishedEpisode episode = run("grid", options);
  ASSERT_EQ(episode.captures.size(), 41U);
  for (std::size_t i = 0; i + 4 < episode.captures.size(); i += 4) {
    const JointPosition& from = episode.captures[i].joints;
    const JointPosition& to = episode.captures[i + 4].joints;
    for (std::size_t k = 1; k < 4; ++k) {
      const Capture& capture = episode.captures[i + k];
      EXPECT_TRUE(capture.is_on_the_way);
      EXPECT_TRUE(std::isnan(capture.predicted_gain));
      EXPECT_EQ(capture.joints, mast.on_the_way(from, to, 0.25 * static_cast<double>(k)));
    }
  }
}

TEST(Episode, ChargesComputingWhenAskedTo) {
  EpisodeOptions options = coarse_options();
  options.charge_computing = true;
  const FinishedEpisode episode = run("auto", options);
  for (std::size_t i = 1; i < episode.captures.size(); ++i) {
    const Capture& before = episode.captures[i - 1];
    EXPECT_NEAR(episode.captures[i].time_s - before.time_s,
                0.5 + 1e-3 * (before.insert_ms + before.grid_ms + before.plan_ms), 1e-9);
  }
}

std::string bytes(const UncertaintyMap& map) {
  const TemporaryFolder folder;
  write_map(map, folder / "map.ot", MapFormat::uncertainty_ot);
  return read_text_file(folder / "map.ot");
}

TEST(Episode, IsTheSameForAnyNumberOfThreads) {
  EpisodeOptions options = coarse_options();
  options.range_noise_m = 0.01;
  for (const std::string& mode : camera_mode_names()) {
    const auto with_threads = [&](std::size_t threads) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      return run(mode, options);
    };
    const FinishedEpisode one = with_threads(1);
    const FinishedEpisode four = with_threads(4);
    EXPECT_EQ(bytes(one.map), bytes(four.map)) << mode;
    EXPECT_EQ(one.summary.information, four.summary.information) << mode;
    EXPECT_EQ(one.summary.prediction.sum_xy, four.summary.prediction.sum_xy) << mode;
  }
}

TEST(Episode, DrawsBySeed) {
  EpisodeOptions options = coarse_options();
  const double first = run("random", options).summary.information;
  EXPECT_EQ(run("random", options).summary.information, first);
  options.seed = 2;
  EXPECT_NE(run("random", options).summary.information, first);
}

TEST(Episode, LeavesTheMapSoFarWhenItEndsEarly) {
  const Scene scene(room_mesh());
  UncertaintyMap map(0.1);
  const auto stop_at_third = [](const Capture& capture) {
    if (capture.frame == 2) throw InputError("the disk is full");
  };
  EXPECT_EQ(message_of<InputError>([&] {
              run_episode(scene, straight_drive(), *make_camera_mode("grid"), coarse_options(), map,
                          stop_at_third);
            }),
            "the disk is full");
  EXPECT_GT(map.counts().information, 0.0);
}

TEST(Episode, RefusesWhatCannotBeRun) {
  const auto refusal = [](const EpisodeOptions& options) {
    return message_of<InputError>([&] { run("static", options); });
  };
  EXPECT_EQ(refusal(coarse_options(0.0)),
            "the motion time of an episode is 0 s, it must be greater than 0 and finite");
  EpisodeOptions options = coarse_options();
  options.capture_hz = -1.0;
  EXPECT_EQ(refusal(options), "the capture rate is -1 Hz, it must be greater than 0 and finite");
  options = coarse_options();
  options.start_joints.height_m = 2.0;
  EXPECT_NE(refusal(options), "");
  EXPECT_EQ(
      message_of<UsageError>([] { make_camera_mode("clever"); }),
      "there is no camera mode 'clever': the modes are static, grid, grid-3, auto, random, oracle");
}

}  // namespace
}  // namespace nbvopt::test
