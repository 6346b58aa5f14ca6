// The versions of what the server stands on.
#pragma once

#include <string>

namespace nbvopt {

/// version_report() and the server's own libraries, one a line.
std::string server_version_report();

}  // namespace nbvopt
