// The nodes of OctoMap's files and messages.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "map/byte_reader.hpp"
#include "map/map_header.hpp"
#include "map/uncertainty_octree.hpp"

namespace nbvopt {

inline constexpr const char* kUncertaintyType = "UncertaintyOcTree";

/// Builds the tree of the nodes that follow a header. `warnings` get a line for what could be read
/// in part only. Throws InputError.
std::unique_ptr<UncertaintyOcTree> read_tree(ByteReader& in, const std::string& name,
                                             const MapHeader& header,
                                             std::vector<std::string>& warnings);

}  // namespace nbvopt
