#include "bench/formatted.hpp"

#include <cstdarg>
#include <cstdio>

namespace nbvopt::bench {

std::string formatted(const char* format, ...) {
  char buffer[256];
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(buffer, sizeof buffer, format, arguments);
  va_end(arguments);
  return buffer;
}

}  // namespace nbvopt::bench
