#include "planner/certify.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/stopwatch.hpp"
#include "gain/gain_bound.hpp"

namespace nbvopt {
namespace {

using detail::BoundBlock;
using detail::GainBound;

/// The boxes with the largest bounds are looked at by the exact gain: so many a level.
constexpr std::size_t kLooks = 32;
/// Of a level: 128 MiB of bounds.
constexpr std::size_t kMostBins = std::size_t{32} << 20;

/// Best first by rounds and levels: a round aims at half the gap of the one before; in a round all
/// boxes of a level that may hold a better view than that are bounded, those that promise most
/// first, before any is cut into smaller ones. What rounds have in common is kept by the bound.
class BranchAndBound {
 public:
  BranchAndBound(const VoxelGrid& grid, const SensorOptions& sensor, const MovingMast& mast,
                 const JointBox& box, const ViewObjective& objective, const CertifyOptions& options,
                 const StopRule& stop)
      : box_(box),
        objective_(objective),
        options_(options),
        stop_(stop),
        bound_(grid, sensor, mast, box) {}

  CertifiedView run(const JointPosition& joints) {
    Certificate& certificate = best_.certificate;
    best_.joints = joints;
    certificate.gain = objective_.view(joints.vector()).gain;
    certificate.upper_bound = std::numeric_limits<double>::infinity();
    bool is_met = true;
    while (is_met && certificate.gap() > options_.gap) {
      target_ = std::max(options_.gap, 0.5 * std::min(target_, certificate.gap()));
      is_met = meets_target();
      certificate.upper_bound =
          std::max(certificate.gain, std::min(certificate.upper_bound, upper_bound()));
    }
    certificate.cones = bound_.cones();
    return best_;
  }

 private:
  /// Bounds all boxes anew, until no better view could add more than the target. Returns false
  /// where it has to stop before.
  bool meets_target() {
    blocks_ = bound_.roots();
    left_ = 0.0F;
    while (tighten_all()) {
      look_at_best();
      if (upper_bound() <= worth()) return true;
      if (!refine()) return false;
    }
    return false;
  }

  /// Boxes up to here need no closer look: the target is met without them. Rounded down, so that it
  /// is met in double precision too.
  float worth() const {
    return std::nextafter(static_cast<float>(best_.certificate.gain / (1.0 - target_)), 0.0F);
  }

  double upper_bound() const {
    float most = left_;
    for (const BoundBlock& block : blocks_) most = std::max(most, block.largest());
    return most;
  }

  bool tighten_all() {
    std::vector<std::pair<float, BoundBlock*>> order;
    for (BoundBlock& block : blocks_) order.emplace_back(block.largest(), &block);
    std::stable_sort(order.begin(), order.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    return std::all_of(order.begin(), order.end(), [&](const auto& next) {
      return bound_.tighten(*next.second, worth(), stop_);
    });
  }

  /// The next level's boxes. Returns false where there are none, or too many.
  bool refine() {
    std::vector<BoundBlock> finer;
    std::size_t bins = 0;
    const float worth = this->worth();
    float left = left_;
    for (const BoundBlock& block : blocks_) {
      for (const float bound : block.bounds) {
        if (bound <= worth) left = std::max(left, bound);
      }
      if (block.largest() <= worth) continue;
      std::vector<BoundBlock> children = bound_.children(block, worth);
      if (children.empty()) return false;
      for (const BoundBlock& child : children) bins += child.bounds.size();
      if (bins > kMostBins) return false;
      std::move(children.begin(), children.end(), std::back_inserter(finer));
    }
    left_ = left;
    blocks_ = std::move(finer);
    return true;
  }

  /// Once a level: the next time the same boxes would be the best.
  void look_at_best() {
    if (blocks_.empty() || blocks_.front().level <= looked_at_level_) return;
    looked_at_level_ = blocks_.front().level;
    struct Bin {
      float bound;
      const BoundBlock* block;
      int pan, tilt;
    };
    std::vector<Bin> bins;
    const auto is_better = [](const Bin& a, const Bin& b) { return a.bound > b.bound; };
    for (const BoundBlock& block : blocks_) {
      for (int t = block.tilt_begin; t < block.tilt_end; ++t) {
        for (int p = block.pan_begin; p < block.pan_end; ++p) {
          const float bound = block.row(t)[p - block.pan_begin];
          if (bins.size() == kLooks && bound <= bins.front().bound) continue;
          if (bins.size() == kLooks) {
            std::pop_heap(bins.begin(), bins.end(), is_better);
            bins.pop_back();
          }
          bins.push_back({bound, &block, p, t});
          std::push_heap(bins.begin(), bins.end(), is_better);
        }
      }
    }
    for (const Bin& bin : bins) {
      const JointBox box = bound_.box_of(*bin.block, bin.pan, bin.tilt);
      const Eigen::Vector3d q = (0.5 * (box.min + box.max)).cwiseMin(box_.max).cwiseMax(box_.min);
      const double gain = objective_.value(q);
      if (gain <= best_.certificate.gain) continue;
      best_.joints = JointPosition::from(q);
      best_.certificate.gain = gain;
      ++best_.certificate.improvements;
    }
  }

  const JointBox& box_;
  const ViewObjective& objective_;
  CertifyOptions options_;
  StopRule stop_;
  GainBound bound_;
  std::vector<BoundBlock> blocks_;  ///< of one level; with what is left, they hold the whole box
  double target_ = 0.32;            ///< the gap that a round aims at, twice the first
  int looked_at_level_ = -1;
  float left_ = 0.0F;  ///< the largest bound of boxes that need no closer look
  CertifiedView best_;
};

}  // namespace

CertifiedView certify(const VoxelGrid& grid, const SensorOptions& sensor, const MovingMast& mast,
                      const JointBox& box, const ViewObjective& objective,
                      const JointPosition& joints, const CertifyOptions& options,
                      const StopRule& stop) {
  const Stopwatch watch;
  StopRule until = StopRule::within(options.time_limit_ms);
  until.cancel = stop.cancel;
  until.max_evaluations = options.max_cones;
  if (stop.deadline) until.deadline = std::min(*until.deadline, *stop.deadline);
  CertifiedView view =
      BranchAndBound(grid, sensor, mast, box, objective, options, until).run(joints);
  view.certificate.time_ms = watch.elapsed_ms();
  return view;
}

}  // namespace nbvopt
