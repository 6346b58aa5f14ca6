// The office as a Gazebo world.
#pragma once

#include <string>

namespace nbvopt {

/// The text of a world file: one static model with a box a wall and piece of furniture.
std::string office_world();

}  // namespace nbvopt
