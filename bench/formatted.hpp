// Text by printf's formats.
#pragma once

#include <string>

namespace nbvopt::bench {

/// What printf would print, up to 255 characters.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);

}  // namespace nbvopt::bench
