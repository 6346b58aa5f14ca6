#include "sim/calibration.hpp"

#include <algorithm>

#include "nbvopt/planner/view_planner.hpp"
#include "sim/random_views.hpp"

namespace nbvopt {
namespace {

/// The camera of `auto`, which is looked over the shoulder at each step.
class JudgedCamera : public CameraMode {
 public:
  explicit JudgedCamera(PredictionJudgement& judgement) : judgement_(judgement) {}

  NextView next_view(const ViewPlanner& planner, const PlanRequest& request,
                     const TrueGain& true_gain) const override {
    constexpr int kRandomViews = 10;
    const PlanResult result = planner.plan(request);
    const double chosen = true_gain(result.joints);
    double best = chosen;
    RandomViews views(result.box, request.seed);
    for (int i = 0; i < kRandomViews; ++i) {
      const JointPosition joints = views.next();
      const double realised = true_gain(joints);
      const Transform T = T_map_sensor(request, planner.mast(), joints);
      judgement_.random.add(planner.evaluate(T).gain, realised);
      best = std::max(best, realised);
    }
    judgement_.chosen_gain += chosen;
    judgement_.best_gain += best;
    return {.joints = result.joints, .predicted_gain = result.view.gain};
  }

 private:
  PredictionJudgement& judgement_;
};

double floor_of(const CalibrationDrive& drive) {
  return drive.trajectory.T_map_base(0.0).translation().z();
}

/// One hit in two metres, so lightly held that the first scans outweigh it.
HazardTable nothing_known(double floor_map_m) {
  HazardTable table(floor_map_m);
  for (std::size_t c = 0; c < HazardTable::kContexts; ++c) {
    table.set(c, {.hits = 0.5, .metres = 1.0});
  }
  return table;
}

/// What was counted since.
HazardTable difference(const HazardTable& now, const HazardTable& before) {
  HazardTable counted(now.floor_map_m());
  for (std::size_t c = 0; c < HazardTable::kContexts; ++c) {
    counted.set(c, {.hits = now.count(c).hits - before.count(c).hits,
                    .metres = now.count(c).metres - before.count(c).metres});
  }
  return counted;
}

struct JudgedEpisode {
  PredictionJudgement judgement;
  HazardTable hazards = HazardTable();
};

JudgedEpisode run(const CalibrationDrive& drive, EpisodeOptions options, const HazardTable& hazards,
                  double resolution_m, const std::function<void(double)>& on_time) {
  options.robot.sensor.gain = GainKind::expected;
  options.hazards = hazards;
  JudgedEpisode episode;
  UncertaintyMap map(resolution_m);
  const EpisodeSummary summary =
      run_episode(drive.scene, drive.trajectory, JudgedCamera(episode.judgement), options, map,
                  [&](const Capture& capture) { on_time(capture.time_s); });
  episode.judgement.chosen = summary.prediction;
  episode.judgement.information = summary.information;
  episode.hazards = summary.hazards;
  return episode;
}

}  // namespace

HazardTable pooled_prior(std::span<const HazardTable> learnt, double floor_map_m) {
  constexpr double kMetres = 2.0;
  HazardTable prior(floor_map_m);
  for (std::size_t c = 0; c < HazardTable::kContexts; ++c) {
    HazardCount sum;
    for (const HazardTable& table : learnt) {
      sum.hits += table.count(c).hits;
      sum.metres += table.count(c).metres;
    }
    if (sum.metres > 0.0) {
      prior.set(c, {.hits = kMetres * sum.hits / sum.metres, .metres = kMetres});
    }
  }
  return prior;
}

Calibration calibrate(std::span<const CalibrationDrive> drives, const EpisodeOptions& options,
                      double resolution_m, const std::function<void(double)>& progress) {
  double all_s = 0.0;
  for (const CalibrationDrive& drive : drives) all_s += 2.0 * drive.trajectory.duration_s();
  double done_s = 0.0;
  const auto on_time = [&](double time_s) { progress((done_s + time_s) / all_s); };

  Calibration calibration;
  std::vector<HazardTable> all;
  for (const CalibrationDrive& drive : drives) {
    const HazardTable nothing = nothing_known(floor_of(drive));
    const JudgedEpisode episode = run(drive, options, nothing, resolution_m, on_time);
    all.push_back(difference(episode.hazards, nothing));
    calibration.drives.push_back({drive.world, all.back(), episode.judgement, {}});
    done_s += drive.trajectory.duration_s();
  }
  for (std::size_t i = 0; i < drives.size(); ++i) {
    std::vector<HazardTable> others;
    for (std::size_t j = 0; j < drives.size(); ++j) {
      if (drives[j].world != drives[i].world) others.push_back(all[j]);
    }
    const HazardTable prior = pooled_prior(others, floor_of(drives[i]));
    calibration.drives[i].left_out =
        run(drives[i], options, prior, resolution_m, on_time).judgement;
    done_s += drives[i].trajectory.duration_s();
  }
  calibration.hazards = pooled_prior(all, drives.empty() ? 0.0 : floor_of(drives.front()));
  return calibration;
}

}  // namespace nbvopt
