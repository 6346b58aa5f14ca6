// The map in the plane that a lidar draws while the robot drives.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace nbvopt {

enum class CellState : std::uint8_t { unknown, free, occupied };

}  // namespace nbvopt
