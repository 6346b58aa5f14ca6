// What a world is put together from.
#pragma once

#include <string>

#include "nbvopt/sim/triangle_mesh.hpp"

namespace nbvopt {

/// One shape in the map frame.
struct WorldPart {
  std::string model;  ///< that it belongs to, nested ones as outer::inner
  TriangleMesh mesh;
  bool is_plane = false;
};

}  // namespace nbvopt
