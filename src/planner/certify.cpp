#include "planner/certify.hpp"

#include <algorithm>
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

/// Best first by level: all boxes of a level that may hold a better view are bounded, those that
/// promise most first, before any is cut into smaller ones.
class BranchAndBound {
 public:
  BranchAndBound(const VoxelGrid& grid, const SensorOptions& sensor, const MovingMast& mast,
                 const JointBox& box, const ViewObjective& objective, const CertifyOptions& options,
                 const StopRule& stop)
      : box_(box),
        objective_(objective),
        options_(options),
        stop_(stop),
        bound_(grid, sensor, mast, box),
        blocks_(bound_.roots()) {}

  CertifiedView run(const JointPosition& joints) {
    best_.joints = joints;
    best_.certificate.gain = objective_.view(joints.vector()).gain;
    while (tighten_all() && !is_met()) {
      look_at_best();
      if (is_met() || !refine()) break;
    }
    best_.certificate.upper_bound = std::max(upper_bound(), best_.certificate.gain);
    best_.certificate.cones = bound_.cones();
    return best_;
  }

 private:
  /// Boxes up to here need no closer look: the gap is met without them.
  float worth() const { return static_cast<float>(best_.certificate.gain / (1.0 - options_.gap)); }

  double upper_bound() const {
    float most = left_;
    for (const BoundBlock& block : blocks_) most = std::max(most, block.largest());
    return most;
  }

  bool is_met() const { return upper_bound() <= worth(); }

  bool tighten_all() {
    std::vector<std::pair<float, BoundBlock*>> order;
    for (BoundBlock& block : blocks_) order.emplace_back(block.largest(), &block);
    std::stable_sort(order.begin(), order.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    return std::all_of(order.begin(), order.end(), [&](const auto& next) {
      return bound_.tighten(*next.second, worth(), stop_);
    });
  }

  /// The next level's boxes. Returns false where there are none.
  bool refine() {
    std::vector<BoundBlock> finer;
    for (const BoundBlock& block : blocks_) {
      if (block.largest() <= worth()) {
        left_ = std::max(left_, block.largest());
        continue;
      }
      std::vector<BoundBlock> children = bound_.children(block);
      if (children.empty()) return false;
      std::move(children.begin(), children.end(), std::back_inserter(finer));
    }
    blocks_ = std::move(finer);
    return true;
  }

  void look_at_best() {
    struct Bin {
      float bound;
      const BoundBlock* block;
      int pan, tilt;
    };
    std::vector<Bin> bins;
    const auto is_better = [](const Bin& a, const Bin& b) { return a.bound > b.bound; };
    for (const BoundBlock& block : blocks_) {
      for (int t = 0; t < block.tilts; ++t) {
        for (int p = 0; p < block.pans; ++p) {
          const float bound = block.bounds[static_cast<std::size_t>(t * block.pans + p)];
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
  float left_ = 0.0F;               ///< the largest bound of boxes that need no closer look
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
