// The files that a page is made of, as they were when the program was built.
#pragma once

#include <span>
#include <string_view>

namespace nbvopt {

struct PagePart {
  std::string_view name;        ///< of the file, without folders
  std::string_view sha256_hex;  ///< of its content
  std::string_view content;
};

/// All of them: scripts in the order in which they run, then style and frame.
std::span<const PagePart> page_parts();

}  // namespace nbvopt
