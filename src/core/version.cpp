#include "nbvopt/core/version.hpp"

#include <Eigen/Core>
#include <sstream>

namespace nbvopt {

const char* version() { return NBVOPT_VERSION; }

std::string version_report() {
  std::ostringstream out;
  out << "nbvopt " << version() << "\nEigen " << EIGEN_WORLD_VERSION << '.' << EIGEN_MAJOR_VERSION
      << '.' << EIGEN_MINOR_VERSION << "\nOctoMap " << NBVOPT_OCTOMAP_VERSION << "\nHighway "
      << NBVOPT_HWY_VERSION << "\ncompiler " << __VERSION__;
  return out.str();
}

}  // namespace nbvopt
