// The option that bounds where a robot explores.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace nbvopt {

/// The corners of "X0,Y0,X1,Y1", a rectangle between two opposite corners, or of a file that has
/// one corner, x and y in metres, a line; empty lines and what follows a # are passed over. Throws
/// InputError that names the file and the line.
std::vector<Eigen::Vector2d> region_argument(const std::string& text);

}  // namespace nbvopt
