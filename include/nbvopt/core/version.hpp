// The library's version.
#pragma once

#include <string>

namespace nbvopt {

/// "major.minor.patch" of this build.
const char* version();

/// The version and those of the libraries that decide its answers, one a line.
std::string version_report();

}  // namespace nbvopt
