#include "sim/exploration/volume/goal_search.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>

#include "core/uniform.hpp"
#include "sim/exploration/volume/gaussian_process.hpp"

namespace nbvopt {
namespace {

constexpr std::size_t kFirstBatch = 15;
constexpr int kRounds = 3;
constexpr double kVarianceWeight = 2.4;

/// Not std::shuffle, which differs between standard libraries.
void shuffle(std::vector<Eigen::Vector3d>& poses, std::mt19937_64& random) {
  for (std::size_t left = poses.size(); left > 1; --left) {
    const auto chosen = static_cast<std::size_t>(uniform(random) * static_cast<double>(left));
    std::swap(poses[chosen], poses[left - 1]);
  }
}

GaussianProcess learnt_from(const std::vector<ScoredPose>& scored, const VolumeRules& rules) {
  std::vector<Eigen::Vector3d> poses;
  Eigen::VectorXd values(static_cast<Eigen::Index>(scored.size()));
  for (const ScoredPose& one : scored) {
    values[static_cast<Eigen::Index>(poses.size())] = one.score;
    poses.push_back(one.pose);
  }
  return {{.length_scale_m = rules.length_scale_m, .wraps_yaw = rules.wraps_yaw}, poses, values};
}

/// Where mean and variance promise the most.
const Eigen::Vector3d& most_promising(const std::vector<Eigen::Vector3d>& candidates,
                                      const GaussianProcess& process) {
  const Eigen::Vector3d* best = nullptr;
  double best_acquisition = -std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& pose : candidates) {
    const GaussianProcess::Prediction prediction = process.predict(pose);
    const double acquisition = prediction.mean + kVarianceWeight * prediction.variance;
    if (acquisition > best_acquisition) {
      best_acquisition = acquisition;
      best = &pose;
    }
  }
  return *best;
}

}  // namespace

std::vector<ScoredPose> best_poses(
    std::vector<Eigen::Vector3d> candidates, const Eigen::Vector2d& robot_map_m,
    const VolumeRules& rules,
    const std::function<double(const Eigen::Vector3d& pose)>& information_m3,
    std::mt19937_64& random) {
  shuffle(candidates, random);
  const std::size_t first_batch =
      std::min(kFirstBatch, candidates.size() - static_cast<std::size_t>(rules.candidates_at_end));
  std::vector<ScoredPose> scored;
  for (std::size_t i = 0; i < first_batch; ++i) {
    const Eigen::Vector3d& pose = candidates[i];
    const double way_m = (pose.head<2>() - robot_map_m).norm();
    // The second is MI / 0.5 * sqrt(...) as C++ reads it.
    const double factor = rules.divides_by_way ? 1.0 / way_m : way_m / 0.5;
    scored.push_back({pose, factor * information_m3(pose)});
  }
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::Vector3d& pose = most_promising(candidates, learnt_from(scored, rules));
    scored.push_back({pose, information_m3(pose)});
  }
  std::ranges::stable_sort(scored, std::ranges::greater{}, &ScoredPose::score);
  return scored;
}

}  // namespace nbvopt
