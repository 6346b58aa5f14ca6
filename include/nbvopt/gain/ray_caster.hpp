// The one primitive that casts rays: everything that looks at a map goes through here.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "nbvopt/core/transform.hpp"
#include "nbvopt/map/voxel_grid.hpp"
#include "nbvopt/sensor/depth_camera.hpp"

namespace nbvopt {

enum class HitKind : std::uint8_t {
  none,      ///< only free voxels up to the far end
  blocked,   ///< an occupied voxel, left before the near end, blocks the ray
  unknown,   ///< the first non-free voxel is unknown
  occupied,  ///< the first non-free voxel is occupied
};

/// The face by which a ray enters a voxel, named by the direction of travel.
enum class Face : std::uint8_t { inside, plus_x, minus_x, plus_y, minus_y, plus_z, minus_z };

/// The axis across a face: 0 for x, 1 for y, 2 for z; not for a ray that starts inside.
constexpr int axis_of(Face face) { return (static_cast<int>(face) - 1) / 2; }

/// Rays from one origin, structure of arrays: unit directions in a frame of the caller's (the
/// sensor's, say), and the distances between which the first non-free voxel decides. All spans
/// have one size.
struct RayBundle {
  Transform T_map_rays = Transform::Identity();  ///< the rays' frame; its origin is theirs
  std::span<const double> x, y, z;
  std::span<const double> range_min_m, range_max_m;
  bool near_blocking = true;

  std::size_t size() const { return x.size(); }
};

/// A camera's rays from T_map_sensor. The bundle looks into `rays`, which must outlive it.
RayBundle make_bundle(const CameraRays& rays, const Transform& T_map_sensor, bool near_blocking);

/// What the rays met, structure of arrays. The storage is reused: keep one a thread.
struct RayHits {
  std::vector<HitKind> kind;
  std::vector<Face> face;          ///< inside when the ray starts in the voxel, at range_min
  std::vector<VoxelKey> voxel;     ///< of an unknown or occupied hit
  std::vector<double> distance_m;  ///< where the ray enters the voxel, at least range_min
  std::vector<float> uncertainty;  ///< u_old of the voxel; 1 when unknown
  /// Every ray's unit direction in the map frame, met something or not.
  std::vector<double> direction_x, direction_y, direction_z;

  std::size_t size() const { return kind.size(); }
  void resize(std::size_t n);
};

/// Instruction sets of the caster; `best` takes what the machine has.
enum class SimdLevel { best, avx512, avx2, sse4, scalar };

/// Casts every ray of the bundle: from the voxel that holds the point at range_min on, the first
/// non-free voxel decides, if the ray enters it before range_max. Every voxel that a ray pierces
/// is visited, or lies in a cube of voxels known to be free. With near_blocking, the voxels from
/// the origin up to range_min are passed first: an occupied one that the ray leaves before
/// range_min blocks the ray.
///
/// `u` of an occupied voxel without stored uncertainty is `occupied_uncertainty`. Fills what the
/// grid must hold. Answers do not depend on how the grid was built.
/// Throws InputError when the origin is not finite or off the lattice.
void cast_rays(const VoxelGrid& grid, const RayBundle& rays, double occupied_uncertainty,
               RayHits& hits, SimdLevel level = SimdLevel::best);

/// The names of the instruction sets that this machine can run, best first.
std::vector<SimdLevel> supported_simd_levels();
const char* to_string(SimdLevel level);

}  // namespace nbvopt
