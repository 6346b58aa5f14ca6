#include "map/ray_bundles.hpp"

#include <numeric>
#include <unordered_map>

namespace nbvopt {

RayBundles::RayBundles(std::span<const RayRun> runs) : runs_(runs.size()), starts_{0} {
  std::vector<std::uint32_t> bundle_of_run;
  bundle_of_run.reserve(runs.size());
  std::unordered_map<std::uint64_t, std::uint32_t> bundle_of_block;
  for (const RayRun& run : runs) {
    const auto bundles = static_cast<std::uint32_t>(bundle_of_block.size());
    const std::uint32_t bundle = bundle_of_block.try_emplace(run.block, bundles).first->second;
    if (bundle == bundles) starts_.push_back(0);
    ++starts_[bundle + 1];
    bundle_of_run.push_back(bundle);
  }
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  std::vector<std::uint32_t> next = starts_;
  for (std::size_t i = 0; i < runs.size(); ++i) runs_[next[bundle_of_run[i]]++] = runs[i];
}

}  // namespace nbvopt
