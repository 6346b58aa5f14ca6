// One layer of a panorama: the hits of rays cast from one place on the mast.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <unordered_map>
#include <vector>

#include "gain/panorama_directions.hpp"
#include "gain/panorama_sum.hpp"
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
  double focal_distance_m;
  double farthest_view_m;  ///< how far views may be from where the layer was cast
  bool per_voxel;
  bool has_lever;
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

  /// Counted from 0, of each hit of a block. Only where the caster says per_voxel.
  std::span<const std::uint32_t, HitBlock::kSize> voxels(std::uint32_t id) const {
    return voxel_[id];
  }

 private:
  struct Storage;

  void cast_run(std::span<const std::uint32_t> ids, Storage& storage);
  void fill(std::uint32_t id, const RayHits& hits, std::size_t first);
  void number_voxels(std::uint32_t id, const RayHits& hits, std::size_t first);

  const LayerCaster& caster_;
  Eigen::Vector3d centre_m_;
  std::unique_ptr<HitBlock[]> blocks_;  ///< not filled before they are cast
  std::vector<std::uint8_t> is_cast_;
  std::vector<float> radius_;    ///< of the directions; below any where nothing was hit
  std::vector<float> nearness_;  ///< 1 / the distance of the nearest hit that there can be
  std::vector<std::array<std::uint32_t, HitBlock::kSize>> voxel_;
  std::unordered_map<std::uint64_t, std::uint32_t> voxel_numbers_;  ///< by packed key
};

}  // namespace nbvopt::detail
