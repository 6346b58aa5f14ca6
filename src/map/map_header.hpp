// The first lines by which OctoMap tells its files apart.
#pragma once

namespace nbvopt {

inline constexpr const char* kBinaryMagic = "# Octomap OcTree binary file";  ///< .bt
inline constexpr const char* kFullMagic = "# Octomap OcTree file";           ///< .ot

}  // namespace nbvopt
