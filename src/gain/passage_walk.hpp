// A ray through unknown space piece by piece, in double precision.
#pragma once

#include <algorithm>
#include <cmath>

#include "gain/ray_passages.hpp"
#include "gain/scalar_ray.hpp"

namespace nbvopt::detail {

/// A voxel in which a ray may meet a surface that the map does not show.
struct PassagePiece {
  VoxelKey voxel;
  double begin_m;  ///< from the origin
  double end_m;
  std::size_t context;  ///< of HazardTable
  bool is_unknown;      ///< otherwise free
};

/// How a walk through the unknown ended.
enum class PassageEnd { far, stopped, occupied };

/// Walks ray i of the bundle from its origin on, calls `visit` with each piece in order, and ends
/// at the first occupied voxel that `ends_at(leaves_m)` does not pass, given the distance at which
/// the ray leaves it; at `far_m`; or where `visit` returns false.
template <class Visit, class EndsAt>
PassageEnd walk_passage(const RayWalk& walk, const HazardTable& hazards, ScalarRay& ray,
                        double direction_z, double far_m, const Visit& visit,
                        const EndsAt& ends_at) {
  const double origin_height_m =
      (walk.origin_key.z() - Lattice::kKeyOfOrigin + walk.origin_in_voxel.z()) * walk.resolution_m -
      hazards.floor_map_m();
  double depth_m = 0.0;
  double begin_m = 0.0;
  ray.start_at(0.0);
  for (;;) {
    const std::uint8_t code = ray.code();
    const int radius = is_free_code(code) ? std::max(leap_radius(code) - kEdgeMargin, 0) : 0;
    const double exit = ray.exit_of_cube(radius);
    const double end_m = exit * walk.resolution_m;
    if (code == kOccupiedCode) {
      if (ends_at(end_m)) return PassageEnd::occupied;
    } else if (is_unknown_code(code)) {
      const double half_m = 0.5 * (end_m - begin_m);
      const double height_m = origin_height_m + 0.5 * (begin_m + end_m) * direction_z;
      const std::size_t context =
          HazardTable::unknown_context(height_m, depth_m + half_m, (code & kBesideSurfaceBit) != 0);
      depth_m += 2.0 * half_m;
      if (!visit(PassagePiece{ray.key(), begin_m, std::min(end_m, far_m), context, true})) {
        return PassageEnd::stopped;
      }
    } else if ((code & kFrontierBit) != 0) {
      const std::size_t context =
          HazardTable::frontier_context((code & kFrontierBesideSurfaceBit) != 0);
      if (!visit(PassagePiece{ray.key(), begin_m, std::min(end_m, far_m), context, false})) {
        return PassageEnd::stopped;
      }
    }
    if (end_m >= far_m) return PassageEnd::far;
    ray.leap(radius, exit);
    begin_m = end_m;
  }
}

/// What a piece of unknown space does to a ray that reaches it.
struct PieceHit {
  double probability;  ///< of a hit in it, given that the ray gets there
  double mean_share;   ///< where such a hit lies on average, 0 at the piece's begin, 1 at its end
};
inline PieceHit piece_hit(double hazard_per_m, double length_m) {
  const double x = hazard_per_m * length_m;
  if (!(x > 0.0)) return {0.0, 0.5};
  if (std::isinf(x)) return {1.0, 0.0};
  // 1 / x - 1 / (exp(x) - 1), by its series where the terms cancel.
  const double share =
      x < 1e-2 ? 0.5 - x / 12.0 + x * x * x / 720.0 : 1.0 / x - 1.0 / std::expm1(x);
  return {-std::expm1(-x), share};
}

/// What of a piece lies in range: where a ray is hit there, and how likely.
struct PassedPiece {
  double probability = 0.0;
  double mean_distance_m = 0.0;
  double length_m = 0.0;
};

/// Takes a ray through a piece: what lies before range_min attenuates only. `transmittance` is the
/// probability that the ray gets to the piece, and then behind it.
inline PassedPiece pass_piece(const PassagePiece& piece, const HazardTable& hazards,
                              double range_min_m, double& transmittance) {
  const double hazard_per_m = hazards.hazard_per_m(piece.context);
  const double split_m = std::clamp(range_min_m, piece.begin_m, piece.end_m);
  transmittance *= 1.0 - piece_hit(hazard_per_m, split_m - piece.begin_m).probability;
  const double length_m = piece.end_m - split_m;
  const PieceHit hit = piece_hit(hazard_per_m, length_m);
  const PassedPiece passed{transmittance * hit.probability, split_m + hit.mean_share * length_m,
                           length_m};
  transmittance *= 1.0 - hit.probability;
  return passed;
}

}  // namespace nbvopt::detail
