// The best view that there is: what searches are measured against.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "nbvopt/mast/mast.hpp"

namespace nbvopt::study {

/// One pass of the search.
struct ReferenceLevel {
  Eigen::Vector3d steps = Eigen::Vector3d::Zero();  ///< of its lattice: rad, rad, m
  std::int64_t evaluations = 0;
  double gain = 0.0;  ///< the best, refined
};

struct Reference {
  double gain = 0.0;
  JointPosition joints;
  std::int64_t evaluations = 0;
  bool has_agreed = false;  ///< whether the last level agrees with the best before
  std::vector<ReferenceLevel> levels;
};

/// Levels agree when their gains differ by less than this share: the exact gain itself jumps by up
/// to 0.15 % within 1e-4 rad.
inline constexpr double kReferenceAgreement = 1e-3;

using GainOfJoints = std::function<double(const JointPosition&)>;

/// Maximises a gain over the box: each level evaluates every point of a lattice over the
/// box, its faces included, climbs from its highest summits by ever smaller steps, and then by
/// steps drawn around the best four. Levels, each with twice the square root of two as many points,
/// follow one another until one agrees with the best before, or five have been searched.
/// Deterministic.
Reference find_reference(const GainOfJoints& gain_of, const JointBox& box);

}  // namespace nbvopt::study
