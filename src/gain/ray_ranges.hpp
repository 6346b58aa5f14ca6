// Where a camera's rays go while it tilts through a range, in cells of directions.
#pragma once

#include <utility>
#include <vector>

#include "gain/bound_row.hpp"
#include "gain/cone_cells.hpp"
#include "nbvopt/sensor/depth_camera.hpp"

namespace nbvopt::detail {

/// The least and the largest azimuth and elevation of each ray, as seen from its pan.
struct RayRanges {
  /// Of cells so wide.
  RayRanges(const CameraRays& rays, double tilt_min_rad, double tilt_max_rad, double cell_rad);

  std::vector<float> azimuth_min, azimuth_max, elevation_min, elevation_max;
  float least_azimuth, largest_azimuth, least_elevation, largest_elevation;
};

/// The cells that any of the rays goes through from bins of pan, which are counted from the same
/// pan as cells, while the base turns by so many cells.
CellBox seen_from(const RayRanges& ranges, int pan_begin, int pan_end,
                  const std::pair<double, double>& turn_cells);

/// The windows of each ray, `cells` being those that there are.
RayWindows windows_of(const RayRanges& ranges, const std::pair<double, double>& turn_cells,
                      const CellBox& cells, const std::vector<float>& angle_part);

}  // namespace nbvopt::detail
