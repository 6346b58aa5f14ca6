// A world as bytes, whole: all that was read of its files, for machines that do not have them.
#pragma once

#include <string>
#include <string_view>

#include "nbvopt/sim/world.hpp"

namespace nbvopt {

std::string pack_world(const World& world);

/// The way back. Throws InputError that says why the bytes are no world of this version's.
World unpack_world(std::string_view bytes);

}  // namespace nbvopt
