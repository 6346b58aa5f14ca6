// One layer of a panorama: the hits of rays cast from one place on the mast.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <unordered_map>
#include <vector>

#include "gain/panorama_directions.hpp"
#include "gain/panorama_sum.hpp"
#include "gain/ray_passages.hpp"
#include "nbvopt/gain/ray_caster.hpp"
#include "nbvopt/map/voxel_grid.hpp"

namespace nbvopt::detail {

/// What casting needs besides directions and place; all of it outlives the layers.
struct LayerCaster {
  const VoxelGrid& grid;
  const PanoramaDirections& directions;
  Eigen::Matrix3d R_map_base;
  double range_min_m;
  double range_max_m;
  bool near_blocking;
  double occupied_uncertainty;
  double weight_distance;  ///< of u_d in u
  double normal_weight;    ///< of u_n in u, which is taken off u_old
  double focal_distance_m;
  double farthest_view_m;  ///< how far views may be from where the layer was cast
  bool per_voxel;
  bool has_lever;
  const PassageModel* passage;  ///< of rays that go on through the unknown; null: they end there
};

class PanoramaLayer {
 public:
  /// Nothing is cast yet.
  PanoramaLayer(const LayerCaster& caster, const Eigen::Vector3d& centre_map_m);

  /// The patches that may have hits in the view, in their order; the half fields of view include
  /// the smooth edges.
  void patches_in_view(const PanoramaView& view, double half_fov_h_rad, double half_fov_v_rad,
                       std::vector<std::uint32_t>& ids) const;

  /// Casts those of the patches that were not cast yet, on all cores. Not thread-safe. Throws what
  /// cast_rays() throws; the patches then count as not cast.
  void cast(std::span<const std::uint32_t> ids);

  const HitBlock* blocks() const { return blocks_.get(); }

  /// The blocks that hold the hits of these patches, which were cast, in their order.
  void blocks_of(std::span<const std::uint32_t> ids, std::vector<std::uint32_t>& blocks) const;

  /// Counted from 0, of each hit of a block. Only where the caster says per_voxel.
  std::span<const std::uint32_t, HitBlock::kSize> voxels(std::uint32_t block) const {
    return voxel_[block];
  }

 private:
  struct Storage;

  /// Blocks that a patch may fill: a ray ends once, or it has two hits in the unknown besides.
  std::uint32_t blocks_a_patch() const { return caster_.passage == nullptr ? 1 : 3; }

  void cast_run(std::span<const std::uint32_t> ids, Storage& storage);
  /// From rays `first` and following, whose origin is `origin_map_m`.
  void fill(std::uint32_t id, const Storage& storage, std::size_t first,
            const Eigen::Vector3d& origin_map_m);
  std::uint32_t number_of(VoxelKey voxel);

  const LayerCaster& caster_;
  Eigen::Vector3d centre_m_;
  std::unique_ptr<HitBlock[]> blocks_;     ///< not filled before they are cast
  std::vector<std::uint8_t> cast_blocks_;  ///< of each patch; 0: it is not cast
  std::vector<float> radius_;              ///< of the directions; below any where nothing was hit
  std::vector<float> nearness_;  ///< 1 / the distance of the nearest hit that there can be
  std::vector<std::array<std::uint32_t, HitBlock::kSize>> voxel_;
  std::unordered_map<std::uint64_t, std::uint32_t> voxel_numbers_;  ///< by packed key
};

}  // namespace nbvopt::detail
