// Which of many poses to drive to.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <random>
#include <vector>

#include "sim/exploration/volume/rules.hpp"

namespace nbvopt {

/// A pose to drive to (x, y, yaw in the map).
struct ScoredPose {
  Eigen::Vector3d pose;
  double score;
};

/// Judges few of the candidates: up to 15 by chance, by their information and the way from the
/// robot, then three by Bayesian optimisation, each the maximum of the acquisition, by their
/// information alone. The best one comes first. There are more candidates than the rules end with;
/// information_m3 may be asked for any.
std::vector<ScoredPose> best_poses(
    std::vector<Eigen::Vector3d> candidates, const Eigen::Vector2d& robot_map_m,
    const VolumeRules& rules,
    const std::function<double(const Eigen::Vector3d& pose)>& information_m3,
    std::mt19937_64& random);

}  // namespace nbvopt
