// Text whose case does not matter.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>

namespace nbvopt {

/// The text with small letters only.
inline std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace nbvopt
