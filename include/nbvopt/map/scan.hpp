// One scan of the camera, and its insertion into a map.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "nbvopt/core/error.hpp"
#include "nbvopt/core/stop.hpp"
#include "nbvopt/core/transform.hpp"
#include "nbvopt/map/uncertainty_map.hpp"
#include "nbvopt/sensor/sensor_options.hpp"

namespace nbvopt {

/// What a driver gives for one frame, in the sensor (optical) frame.
struct Scan {
  std::vector<Eigen::Vector3f> points_m;             ///< returns; not finite ones are ignored
  std::vector<std::array<std::uint8_t, 3>> colours;  ///< one a point, or empty
  std::vector<Eigen::Vector3f> no_returns;           ///< directions in which nothing is in range
};

/// Where the points of a scan lie; each point and each direction counts once.
struct ScanCounts {
  std::uint64_t points_used = 0;        ///< returns with D_min < d < D_max
  std::uint64_t points_too_near = 0;    ///< d <= D_min
  std::uint64_t points_too_far = 0;     ///< d >= D_max
  std::uint64_t no_returns = 0;         ///< directions in which nothing is in range
  std::uint64_t points_not_finite = 0;  ///< directions that are not finite or zero, too
  std::uint64_t points_off_lattice = 0;
  /// The ranges of the finite points but the origin, which many drivers give for no data; NaN
  /// where there is none.
  double nearest_m = std::numeric_limits<double>::quiet_NaN();
  double farthest_m = std::numeric_limits<double>::quiet_NaN();
};

/// What an insertion did.
struct InsertResult : ScanCounts {
  std::vector<VoxelChange> changes;        ///< every voxel whose state or u changed, once
  std::vector<VoxelKey> tiles;             ///< that were written: cubes of 64^3 voxels, least keys
  std::uint64_t rays_cleared = 0;          ///< no-returns, and returns at or beyond D_max, cleared
  std::uint64_t points_ignored = 0;        ///< nearer than D_min, not finite, or off the lattice
  double information_gained = 0.0;         ///< what the map's Eq. 11 grew by
  std::int64_t certain_voxels_gained = 0;  ///< what its occupied voxels with u < 1 grew by
};

/// What makes an insertion give up. The default never does.
struct InsertLimits {
  CancelToken cancel;  ///< raised by another thread
  /// What inserting may take at most, bytes, by an upper bound: the nodes and bricks that are new
  /// and the list of changes, while a grid is updated by them.
  std::uint64_t max_bytes = std::numeric_limits<std::uint64_t>::max();
};

/// A scan that would take more memory than InsertLimits allow.
class ScanTooLargeError : public InputError {
 public:
  using InputError::InputError;
};

/// Inserts a scan taken from T_map_sensor: the voxels that a ray passes become freer, the one
/// that holds the point becomes more occupied and keeps the minimum u of all its observations,
/// the first included (Eq. 9). Occupied wins over free within one scan. A return at or beyond
/// D_max says the same as no return: its ray is clear up to D_max, the last voxel included
/// (unless `no_return` is ignore). Throws InputError when the pose is not finite or lies off the
/// lattice, the sensor's options are bad, or every point lies farther than 50 D_max, which is a
/// slip of the unit and would clear the map; UsageError when colours and points differ in number;
/// ScanTooLargeError beyond `limits`, and CancelledError some milliseconds after they were
/// cancelled, unless all that is left is writing what one camera sees. The map is then untouched.
InsertResult insert_scan(UncertaintyMap& map, const Scan& scan, const Transform& T_map_sensor,
                         const SensorOptions& sensor, const InsertLimits& limits = {});

/// Where the points lie, by their range alone.
ScanCounts count_scan(const Scan& scan, const SensorOptions& sensor);

/// Why a scan of which no point is in range is likely not what was meant (its unit, its scale, its
/// frame), in one line; empty where a point is in range. Inserted, such a scan can only clear.
std::string none_in_range(const ScanCounts& counts, const SensorOptions& sensor);

}  // namespace nbvopt
