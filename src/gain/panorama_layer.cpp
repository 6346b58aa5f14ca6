#include "gain/panorama_layer.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "gain/normal_part.hpp"
#include "gain/passage_nodes.hpp"
#include "gain/patch_culling.hpp"
#include "nbvopt/sensor/uncertainty_model.hpp"

namespace nbvopt::detail {
namespace {

constexpr float kNothingHit = -10.0F;  // a radius that lies in no view
/// Where a ray meets a face at a smaller sine, the face stands for more surface than the ray's
/// neighbours see.
constexpr double kGrazing = 0.05;
constexpr std::size_t kPatchesATask = 64;
constexpr double kNoShare = 1e-6;  // of a ray; hits with less do not count

/// Whether a view from near the layer may gain from a hit: where u_old may exceed u_new.
bool may_gain(const LayerCaster& caster, double u_old, double distance_m) {
  if (u_old >= 1.0) return true;
  constexpr double kRounding = 0.01;  // of the rounded-off corners in the sum
  const double d_focal =
      std::max(0.0, std::abs(distance_m - caster.focal_distance_m) - caster.farthest_view_m);
  const double u_distance = UncertaintyModel::focal_uncertainty(d_focal);
  return u_old > caster.weight_distance * u_distance - kRounding;
}

}  // namespace

/// The rays of a run of patches and their hits, kept a thread.
struct PanoramaLayer::Storage {
  std::vector<double> x, y, z, range_min_m, range_max_m;
  RayHits hits;          ///< where rays end in the unknown
  RayPassages passages;  ///< where they go on
};

PanoramaLayer::PanoramaLayer(const LayerCaster& caster, const Eigen::Vector3d& centre_map_m)
    : caster_(caster),
      centre_m_(centre_map_m),
      blocks_(std::make_unique_for_overwrite<HitBlock[]>(blocks_a_patch() *
                                                         caster.directions.patch_count())),
      cast_blocks_(caster.directions.patch_count(), 0),
      radius_(caster.directions.radius),
      nearness_(caster.directions.patch_count(), static_cast<float>(1.0 / caster.range_min_m)) {
  if (caster.per_voxel) voxel_.resize(blocks_a_patch() * caster.directions.patch_count());
}

void PanoramaLayer::patches_in_view(const PanoramaView& view, double half_fov_h_rad,
                                    double half_fov_v_rad, std::vector<std::uint32_t>& ids) const {
  detail::patches_in_view(caster_.directions, radius_, nearness_, view, half_fov_h_rad,
                          half_fov_v_rad, ids);
}

void PanoramaLayer::cast(std::span<const std::uint32_t> ids) {
  thread_local std::vector<std::uint32_t> missing;
  missing.clear();
  for (const std::uint32_t id : ids) {
    if (cast_blocks_[id] == 0) missing.push_back(id);
  }
  if (missing.empty()) return;
  const std::span<const std::uint32_t> all(missing);
  // Voxels are numbered in the order of their patches.
  const bool in_order = caster_.per_voxel || all.size() <= kPatchesATask;
  const auto cast_from = [&](std::size_t first, std::size_t count) {
    thread_local Storage storage;
    cast_run(all.subspan(first, std::min(count, all.size() - first)), storage);
  };
  if (in_order) {
    cast_from(0, all.size());
    return;
  }
  const std::size_t tasks = (all.size() + kPatchesATask - 1) / kPatchesATask;
  // A caller that waits for these tasks holds a lock: it must not take up others that ask for it.
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(std::size_t{0}, tasks,
                      [&](std::size_t task) { cast_from(task * kPatchesATask, kPatchesATask); });
  });
}

void PanoramaLayer::cast_run(std::span<const std::uint32_t> ids, Storage& storage) {
  constexpr std::size_t kRays = HitBlock::kSize;
  const PanoramaDirections& directions = caster_.directions;
  // A lever arm gives each patch an origin of its own.
  const std::size_t run = caster_.has_lever ? 1 : ids.size();
  for (std::size_t first = 0; first < ids.size(); first += run) {
    storage.x.resize(run * kRays);
    storage.y.resize(run * kRays);
    storage.z.resize(run * kRays);
    storage.range_min_m.assign(run * kRays, caster_.range_min_m);
    storage.range_max_m.assign(run * kRays, caster_.range_max_m);
    for (std::size_t i = 0; i < run; ++i) {
      const std::size_t ray = ids[first + i] * kRays;
      std::copy_n(&directions.x[ray], kRays, &storage.x[i * kRays]);
      std::copy_n(&directions.y[ray], kRays, &storage.y[i * kRays]);
      std::copy_n(&directions.z[ray], kRays, &storage.z[i * kRays]);
    }
    RayBundle rays;
    rays.T_map_rays.linear() = caster_.R_map_base;
    rays.T_map_rays.translation() = centre_m_;
    if (caster_.has_lever) {
      const std::uint32_t id = ids[first];
      rays.T_map_rays.translation() +=
          Eigen::Vector3f(directions.lever_x[id], directions.lever_y[id], directions.lever_z[id])
              .cast<double>();
    }
    rays.x = storage.x;
    rays.y = storage.y;
    rays.z = storage.z;
    rays.range_min_m = storage.range_min_m;
    rays.range_max_m = storage.range_max_m;
    rays.near_blocking = caster_.near_blocking;
    if (caster_.passage == nullptr) {
      cast_rays(caster_.grid, rays, caster_.occupied_uncertainty, storage.hits);
      take_normal_part(caster_.grid, caster_.normal_weight, storage.hits);
    } else {
      pass_rays(caster_.grid, rays, caster_.occupied_uncertainty, *caster_.passage,
                storage.passages);
      take_normal_part(caster_.grid, caster_.normal_weight, storage.passages.end);
    }
    for (std::size_t i = 0; i < run; ++i) {
      fill(ids[first + i], storage, i * kRays, rays.T_map_rays.translation());
    }
  }
}

void PanoramaLayer::blocks_of(std::span<const std::uint32_t> ids,
                              std::vector<std::uint32_t>& blocks) const {
  blocks.clear();
  for (const std::uint32_t id : ids) {
    for (std::uint32_t b = 0; b < cast_blocks_[id]; ++b) {
      blocks.push_back(id * blocks_a_patch() + b);
    }
  }
}

void PanoramaLayer::fill(std::uint32_t id, const Storage& storage, std::size_t first,
                         const Eigen::Vector3d& origin_map_m) {
  const PanoramaDirections& directions = caster_.directions;
  const RayHits& hits = caster_.passage == nullptr ? storage.hits : storage.passages.end;
  const std::uint32_t first_block = id * blocks_a_patch();
  double nearest_m = std::numeric_limits<double>::infinity();
  std::array<std::uint32_t, HitBlock::kSize> filled{};  // of a ray's lane, from block to block
  std::uint32_t blocks = 0;
  const auto open_block = [&] {
    HitBlock& block = blocks_[first_block + blocks++];
    block = {};
    block.farthest_m.fill(std::numeric_limits<float>::max());
    // Lanes without a hit lie where a view can project them.
    for (std::size_t i = 0; i < HitBlock::kSize; ++i) {
      const std::size_t k = first + i;
      block.x[i] = static_cast<float>(directions.lever_x[id] + hits.direction_x[k]);
      block.y[i] = static_cast<float>(directions.lever_y[id] + hits.direction_y[k]);
      block.z[i] = static_cast<float>(directions.lever_z[id] + hits.direction_z[k]);
    }
  };
  open_block();

  // A hit of a ray that has this share of it; `face`: by which the ray enters it.
  const auto add = [&](std::size_t i, double distance_m, double share, Face face, float u_old,
                       VoxelKey voxel) {
    const std::size_t k = first + i;
    const Eigen::Vector3d direction(hits.direction_x[k], hits.direction_y[k], hits.direction_z[k]);
    nearest_m = std::min(nearest_m, distance_m);
    const double seen = share * directions.solid_angle[id * HitBlock::kSize + i] *
                        std::max(0.0, distance_m + directions.apex_beside[id]) *
                        std::max(0.0, distance_m + directions.apex_above[id]);
    Eigen::Vector3d area = Eigen::Vector3d::Zero();
    const int axis = axis_of(face);
    if (face == Face::inside || std::abs(direction[axis]) < kGrazing) {
      area = seen * direction;
    } else {
      area[axis] = seen / direction[axis];
    }
    const std::uint32_t b = filled[i]++;
    if (b == blocks) open_block();
    HitBlock& block = blocks_[first_block + b];
    block.x[i] = static_cast<float>(directions.lever_x[id] + distance_m * direction.x());
    block.y[i] = static_cast<float>(directions.lever_y[id] + distance_m * direction.y());
    block.z[i] = static_cast<float>(directions.lever_z[id] + distance_m * direction.z());
    block.area_x[i] = static_cast<float>(area.x());
    block.area_y[i] = static_cast<float>(area.y());
    block.area_z[i] = static_cast<float>(area.z());
    block.u_old[i] = u_old;
    if (caster_.per_voxel) voxel_[first_block + b][i] = number_of(voxel);
    return &block.farthest_m[i];
  };

  for (std::size_t i = 0; i < HitBlock::kSize; ++i) {
    const std::size_t k = first + i;
    double end_share = 1.0;
    if (caster_.passage != nullptr) {
      end_share = storage.passages.end_probability[k];
      const Eigen::Vector3d direction(hits.direction_x[k], hits.direction_y[k],
                                      hits.direction_z[k]);
      for (const PassageNode& node : passage_nodes(storage.passages, k)) {
        if (node.probability < kNoShare) continue;
        add(i, node.distance_m, node.probability, Face::inside,
            static_cast<float>(unknown_without_normal_part(caster_.normal_weight)),
            caster_.grid.lattice().key(origin_map_m + node.distance_m * direction));
      }
    }
    const double distance_m = hits.distance_m[k];
    if (hits.kind[k] < HitKind::unknown || end_share < kNoShare ||
        !may_gain(caster_, hits.uncertainty[k], distance_m)) {
      continue;
    }
    float* farthest_m =
        add(i, distance_m, end_share, hits.face[k], hits.uncertainty[k], hits.voxel[k]);
    if (hits.face[k] == Face::inside) *farthest_m = static_cast<float>(caster_.range_min_m);
  }
  if (std::isinf(nearest_m)) radius_[id] = kNothingHit;
  nearness_[id] = static_cast<float>(1.0 / nearest_m);
  cast_blocks_[id] = static_cast<std::uint8_t>(blocks);
}

std::uint32_t PanoramaLayer::number_of(VoxelKey voxel) {
  const auto next = static_cast<std::uint32_t>(voxel_numbers_.size());
  return voxel_numbers_.try_emplace(packed(voxel), next).first->second;
}

}  // namespace nbvopt::detail
