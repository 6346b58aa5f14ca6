// The rays of a scan, gathered by where they end.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "map/ray_ends.hpp"

namespace nbvopt {

/// Runs of the same block, in the order of the scan.
class RayBundles {
 public:
  explicit RayBundles(std::span<const RayRun> runs);

  std::size_t size() const { return starts_.size() - 1; }
  std::span<const RayRun> operator[](std::size_t bundle) const {
    return std::span(runs_).subspan(starts_[bundle], starts_[bundle + 1] - starts_[bundle]);
  }

 private:
  std::vector<RayRun> runs_;
  std::vector<std::uint32_t> starts_;  ///< of each bundle in runs_, and where the last one ends
};

}  // namespace nbvopt
