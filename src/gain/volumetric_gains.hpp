// The gains that others have published, by their names: one function each.
#pragma once

#include <functional>

#include "gain/surface_distances.hpp"
#include "gain/view_rays.hpp"
#include "nbvopt/sensor/sensor_options.hpp"

namespace nbvopt::detail {

/// p_occ of voxels by their state. A map's log-odds are clamped to these values after a few looks,
/// and grids keep states alone.
inline constexpr double kFreeProbability = 0.12;
inline constexpr double kOccupiedProbability = 0.97;
inline constexpr double kUnknownProbability = 0.5;

/// How far behind surfaces unknown voxels count as near them.
inline constexpr double kSurfaceReach_m = 0.3;

/// A view as these gains see it.
struct SeenView {
  const ViewRays& rays;
  const SensorOptions& sensor;
  const VoxelGrid& grid;
  const SurfaceDistances& distances;  ///< up to kSurfaceReach_m
  Eigen::Vector3d camera_m;           ///< in the map frame
};

/// The gain of that name. Throws UsageError for `positive` and `expected`, which look at u.
double volumetric_gain(GainKind kind, const SeenView& view);

/// Takes a voxel, which may come again, and what it adds.
using AddPart = std::function<void(const RayVoxel& voxel, double part)>;

/// Calls add() with the parts of which that gain is the sum. False: it is no sum over voxels.
/// Throws as volumetric_gain() does.
bool add_parts(GainKind kind, const SeenView& view, const AddPart& add);

}  // namespace nbvopt::detail
