// Puts a page together from the files in page/.
#pragma once

#include <span>
#include <string>

#include "core/json.hpp"

namespace nbvopt {

/// Data that stand in a page beside its JSON, as packed.hpp packs them.
struct PageBlock {
  std::string id;  ///< letters and hyphens
  std::string base64;
};

/// One HTML file that needs no other and no network. Its security policy names the hashes of its
/// own scripts, so that nothing else in it is ever run, and allows no connection. `title` and
/// `data` may hold any text.
std::string page_html(const std::string& title, const Json& data,
                      std::span<const PageBlock> blocks);

}  // namespace nbvopt
