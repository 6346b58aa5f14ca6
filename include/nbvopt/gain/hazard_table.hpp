// How likely a ray meets a surface where the map does not show one.
//
// Inside unknown space the first hit is taken as exponential: it comes with a hazard of l hits a
// metre, which depends on the context that the ray is in there. Hazards are learnt from scans by
// censored maximum likelihood, l = hits / metres, metres being those that rays passed in that
// context, up to their hit or past it.
#pragma once

#include <array>
#include <cstddef>

#include "nbvopt/core/transform.hpp"
#include "nbvopt/map/scan.hpp"
#include "nbvopt/map/voxel_grid.hpp"
#include "nbvopt/sensor/sensor_options.hpp"

namespace nbvopt {

/// How often surfaces were met in a context.
struct HazardCount {
  double hits = 0.0;
  double metres = 0.0;  ///< of rays

  bool operator==(const HazardCount&) const = default;
};

/// Hits and metres by context. A context is, in unknown space, the height above the floor (below
/// 0.15 m, below 1.8 m, above), how far the ray has come through the unknown (below 0.3 m, beyond)
/// and whether the voxel shares a face with an occupied one; and, since a voxel that is free where
/// it was seen may hold a surface where it was not, free voxels that share a face with an unknown
/// one, and an occupied one or not.
class HazardTable {
 public:
  static constexpr double kFloorBand_m = 0.15;
  static constexpr double kCeilingBand_m = 1.8;
  static constexpr double kDeep_m = 0.3;
  static constexpr std::size_t kUnknownContexts = 12;
  static constexpr std::size_t kContexts = kUnknownContexts + 2;

  /// Of an unknown voxel in whose middle the ray is so high above the floor and has come so far
  /// through unknown voxels.
  static std::size_t unknown_context(double height_m, double depth_m, bool beside_surface) {
    const std::size_t band = height_m < kFloorBand_m ? 0 : height_m < kCeilingBand_m ? 1 : 2;
    return 4 * band + (depth_m < kDeep_m ? 0 : 2) + (beside_surface ? 1 : 0);
  }
  /// Of a free voxel beside an unknown one.
  static std::size_t frontier_context(bool beside_surface) {
    return kUnknownContexts + (beside_surface ? 1 : 0);
  }

  /// What drives through four worlds taught, with the weight of two metres a context. Heights count
  /// from `floor_map_m`, the z of the floor in the map.
  explicit HazardTable(double floor_map_m = 0.0);

  /// The same hazard in all unknown space and none in free voxels. Infinite: whatever is unknown
  /// is a surface, as Eq. 12 has it. Nothing is learnt from then on but what is added.
  static HazardTable uniform(double hits_per_m);

  /// Hits a metre.
  double hazard_per_m(std::size_t context) const {
    return counts_[context].hits / counts_[context].metres;
  }

  /// What was added, and the prior.
  const HazardCount& count(std::size_t context) const { return counts_[context]; }

  void add(std::size_t context, const HazardCount& count) {
    counts_[context].hits += count.hits;
    counts_[context].metres += count.metres;
  }

  /// Forgets the context's prior and all that was added.
  void set(std::size_t context, const HazardCount& count) { counts_[context] = count; }

  double floor_map_m() const { return floor_map_m_; }

  /// Of all contexts together.
  HazardCount total() const {
    HazardCount sum;
    for (const HazardCount& count : counts_) {
      sum.hits += count.hits;
      sum.metres += count.metres;
    }
    return sum;
  }

  bool operator==(const HazardTable&) const = default;

 private:
  double floor_map_m_;
  std::array<HazardCount, kContexts> counts_;
};

/// Learns from a scan that `grid` does not show yet: walks about 500 of its rays through the map
/// and adds their hits and metres. Returns beyond the sensor's range and no-returns pass up to the
/// far end; what lies nearer than the near end is not looked at. Throws InputError when the pose is
/// not finite or lies off the lattice.
void learn_hazards(const VoxelGrid& grid, const Scan& scan, const Transform& T_map_sensor,
                   const SensorOptions& sensor, HazardTable& hazards);

}  // namespace nbvopt
