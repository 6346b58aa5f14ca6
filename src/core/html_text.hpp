// Text within a page.
#pragma once

#include <string>
#include <string_view>

namespace nbvopt {

/// Text as HTML shows it, quotes of attributes included.
std::string html_escaped(std::string_view text);

}  // namespace nbvopt
