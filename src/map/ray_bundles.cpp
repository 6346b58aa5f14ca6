#include "map/ray_bundles.hpp"

#include <numeric>
#include <optional>
#include <unordered_map>

#include "nbvopt/map/voxel.hpp"

namespace nbvopt {

namespace {

constexpr int kBlockBits = 2;
constexpr int kBlockSize = 1 << kBlockBits;  // voxels

/// A block of voxels.
class Block {
 public:
  explicit Block(const Eigen::Vector3i& voxel)
      : place_(voxel.x() >> kBlockBits, voxel.y() >> kBlockBits, voxel.z() >> kBlockBits) {}

  std::uint64_t number() const {
    return packed({static_cast<std::uint16_t>(place_.x()), static_cast<std::uint16_t>(place_.y()),
                   static_cast<std::uint16_t>(place_.z())});
  }

  /// Whether a voxel lies in the block or beside it.
  bool is_near(const Eigen::Vector3i& voxel) const {
    const Eigen::Array3i inside = voxel.array() - place_.array() * kBlockSize;
    return (inside >= -1).all() && (inside <= kBlockSize).all();
  }

 private:
  Eigen::Vector3i place_;
};

}  // namespace

RayBundles::RayBundles(std::span<const Eigen::Vector3d> ends) {
  std::vector<RayRun> runs;
  std::vector<std::uint32_t> bundle_of_run;
  std::unordered_map<std::uint64_t, std::uint32_t> bundle_of_block;
  starts_.push_back(0);
  std::optional<Block> block;  // of the last run
  Eigen::AlignedBox3d box;     // of its ends
  for (std::uint32_t i = 0; i < ends.size(); ++i) {
    const Eigen::Vector3i voxel = ends[i].cast<int>();
    if (!block || !block->is_near(voxel)) {
      block.emplace(voxel);
      const auto bundles = static_cast<std::uint32_t>(bundle_of_block.size());
      const std::uint32_t bundle =
          bundle_of_block.try_emplace(block->number(), bundles).first->second;
      if (bundle == bundles) starts_.push_back(0);
      ++starts_[bundle + 1];
      bundle_of_run.push_back(bundle);
      if (!runs.empty()) runs.back().ends = box;
      box.setEmpty();
      runs.push_back({i, 0, {}});
    }
    ++runs.back().count;
    box.extend(ends[i]);
  }
  if (!runs.empty()) runs.back().ends = box;
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  runs_.resize(runs.size());
  std::vector<std::uint32_t> next = starts_;
  for (std::size_t i = 0; i < runs.size(); ++i) runs_[next[bundle_of_run[i]]++] = runs[i];
}

}  // namespace nbvopt
