// Parts that lie far from everything else.
#pragma once

#include <vector>

#include "sim/world/world_log.hpp"
#include "sim/world/world_part.hpp"

namespace nbvopt {

/// Removes parts that were lost at a great distance, hundreds of kilometres say, and logs them:
/// they would blow up every grid that spans the world. The rest of the world decides what is far.
void remove_stray_parts(std::vector<WorldPart>& parts, WorldLog& log);

}  // namespace nbvopt
