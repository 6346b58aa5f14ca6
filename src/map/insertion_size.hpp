// What writing a scan's marks may take, before anything is written.
#pragma once

#include <cstdint>

#include "map/mark_window.hpp"

namespace nbvopt {

/// An upper bound in bytes, of a summarised window: of the nodes that the octree may get, of the
/// bricks that the grid makes anew, and of the list of changes with its copy while the grid is
/// updated.
std::uint64_t most_bytes_to_insert(const MarkWindow& window);

}  // namespace nbvopt
