// Man pages.
#pragma once

#include <string>

#include "cli/describe/command.hpp"

namespace nbvopt {

/// The page of one command in man(7)'s macros, section 1.
std::string man_page(const Command& command, const std::string& version);

/// "nbvopt map info" as pages are named: "nbvopt-map-info".
std::string page_name(const Command& command);

}  // namespace nbvopt
