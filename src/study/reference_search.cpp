#include "study/reference_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "core/uniform.hpp"

namespace nbvopt::study {
namespace {

using Vector = Eigen::Vector3d;
using Indices = std::array<Eigen::Index, 3>;

/// Of the first lattice: pan, tilt (rad), height (m).
const Vector kFirstSteps{0.1, 0.1, 0.06};
/// Where climbing stops: below it the gain is rough, not steep.
const Vector kLastSteps{5e-4, 5e-4, 5e-4};
constexpr int kMostLevels = 5;
constexpr std::size_t kSummits = 24;
constexpr std::size_t kDrawnAround = 6;
constexpr int kDraws = 1000;

/// The 26 ways from a point of a lattice to those around it.
const std::vector<Indices> kNeighbours = [] {
  std::vector<Indices> steps;
  for (const Eigen::Index i : {-1, 0, 1}) {
    for (const Eigen::Index j : {-1, 0, 1}) {
      for (const Eigen::Index k : {-1, 0, 1}) {
        if (i != 0 || j != 0 || k != 0) steps.push_back({i, j, k});
      }
    }
  }
  return steps;
}();

struct Candidate {
  Vector q = Vector::Zero();
  double gain = -1.0;
};

class GainOverBox {
 public:
  GainOverBox(const GainOfJoints& gain, const JointBox& box) : gain_(gain), box_(box) {}

  Candidate at(const Vector& q) {
    ++evaluations_;
    const Vector inside = q.cwiseMax(box_.min).cwiseMin(box_.max);
    return {inside, gain_(JointPosition::from(inside))};
  }
  const JointBox& box() const { return box_; }
  std::int64_t evaluations() const { return evaluations_; }

 private:
  const GainOfJoints& gain_;
  const JointBox& box_;
  std::int64_t evaluations_ = 0;
};

/// Points from face to face of a box, equally far apart along each joint.
class Lattice3 {
 public:
  Lattice3(const JointBox& box, const Vector& longest_steps) : box_(box) {
    for (Eigen::Index i = 0; i < 3; ++i) {
      const double width = box.max[i] - box.min[i];
      points_[i] =
          width > 0.0 ? static_cast<Eigen::Index>(std::ceil(width / longest_steps[i])) + 1 : 1;
      steps_[i] = points_[i] > 1 ? width / static_cast<double>(points_[i] - 1) : 0.0;
    }
  }

  const Vector& steps() const { return steps_; }
  std::size_t size() const {
    return static_cast<std::size_t>(points_[0] * points_[1] * points_[2]);
  }

  Vector point(std::size_t number) const {
    const Indices at = indices(number);
    Vector q = box_.min;
    for (Eigen::Index i = 0; i < 3; ++i) q[i] += steps_[i] * static_cast<double>(at[i]);
    return q;
  }

  /// Whether none of the 26 neighbours has more, nor as much with a smaller number: a plateau is
  /// one summit. Along joints alone every point of a slanting ridge would be one.
  bool is_summit(std::size_t number, const std::vector<double>& gains) const {
    const Indices at = indices(number);
    for (const Indices& step : kNeighbours) {
      Eigen::Index neighbour = 0;
      bool is_inside = true;
      for (std::size_t i = 0; i < 3; ++i) {
        const Eigen::Index there = at[i] + step[i];
        is_inside = is_inside && there >= 0 && there < points_[i];
        neighbour = neighbour * points_[i] + there;
      }
      if (!is_inside) continue;
      const auto other = static_cast<std::size_t>(neighbour);
      if (gains[other] > gains[number]) return false;
      if (gains[other] == gains[number] && other < number) return false;
    }
    return true;
  }

 private:
  Indices indices(std::size_t number) const {
    const auto n = static_cast<Eigen::Index>(number);
    return {n / (points_[1] * points_[2]), n / points_[2] % points_[1], n % points_[2]};
  }

  const JointBox& box_;
  Vector steps_ = Vector::Zero();
  Indices points_{};
};

/// The highest summits of the lattice, highest first.
std::vector<Candidate> summits(GainOverBox& gain, const Lattice3& lattice) {
  std::vector<double> gains(lattice.size());
  for (std::size_t i = 0; i < gains.size(); ++i) gains[i] = gain.at(lattice.point(i)).gain;
  std::vector<Candidate> found;
  for (std::size_t i = 0; i < gains.size(); ++i) {
    if (lattice.is_summit(i, gains)) found.push_back({lattice.point(i), gains[i]});
  }
  std::ranges::stable_sort(found, std::greater(), &Candidate::gain);
  found.resize(std::min(found.size(), kSummits));
  return found;
}

/// Steps along joints and diagonals, halved when none goes up.
Candidate climb(GainOverBox& gain, Candidate best, Vector steps) {
  while ((steps.array() > kLastSteps.array()).any()) {
    const double before = best.gain;
    for (const Indices& way : kNeighbours) {
      const Vector offset = steps.cwiseProduct(Vector(
          static_cast<double>(way[0]), static_cast<double>(way[1]), static_cast<double>(way[2])));
      if (offset.isZero(0.0)) continue;
      const Candidate next = gain.at(best.q + offset);
      if (next.gain > best.gain) best = next;
    }
    if (best.gain == before) steps *= 0.5;
  }
  return best;
}

/// Tries points around the best, at distances of all scales up to twice the lattice's steps.
Candidate draw_around(GainOverBox& gain, Candidate best, const Vector& steps) {
  if (steps.isZero(0.0)) return best;
  std::mt19937_64 generator(1);
  for (int i = 0; i < kDraws; ++i) {
    const double scale = std::pow(2.0, 1.0 - 9.0 * uniform(generator));
    Vector offset;
    for (Eigen::Index joint = 0; joint < 3; ++joint) {
      offset[joint] = scale * steps[joint] * (2.0 * uniform(generator) - 1.0);
    }
    const Candidate next = gain.at(best.q + offset);
    if (next.gain > best.gain) best = next;
  }
  return best;
}

Candidate search_level(GainOverBox& gain, const Lattice3& lattice) {
  std::vector<Candidate> climbed;
  for (const Candidate& summit : summits(gain, lattice)) {
    climbed.push_back(climb(gain, summit, 0.5 * lattice.steps()));
  }
  std::ranges::stable_sort(climbed, std::greater(), &Candidate::gain);
  climbed.resize(std::min(climbed.size(), kDrawnAround));
  Candidate best;
  for (const Candidate& candidate : climbed) {
    const Candidate drawn = draw_around(gain, candidate, lattice.steps());
    if (drawn.gain > best.gain) best = drawn;
  }
  return best;
}

bool agree(double a, double b) { return std::abs(a - b) <= kReferenceAgreement * std::max(a, b); }

}  // namespace

Reference find_reference(const GainOfJoints& gain_of, const JointBox& box) {
  GainOverBox gain(gain_of, box);
  Reference reference;
  Candidate best;
  for (int level = 0; level < kMostLevels && !reference.has_agreed; ++level) {
    const Lattice3 lattice(box, kFirstSteps * std::pow(std::numbers::sqrt2, -level));
    const std::int64_t before = gain.evaluations();
    const Candidate found = search_level(gain, lattice);
    // With the best of all: a level that falls behind it confirms nothing.
    reference.has_agreed = level > 0 && agree(found.gain, best.gain);
    if (found.gain > best.gain) best = found;
    reference.levels.push_back({lattice.steps(), gain.evaluations() - before, found.gain});
  }
  reference.gain = best.gain;
  reference.joints = JointPosition::from(best.q);
  reference.evaluations = gain.evaluations();
  return reference;
}

}  // namespace nbvopt::study
