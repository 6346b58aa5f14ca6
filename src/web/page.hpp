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

enum class PageKind {
  saved,  ///< holds all that it shows, and opens no connection
  live,   ///< asks its own server for it
};

/// On one line and in ASCII, whatever names and messages hold.
std::string line_of(const Json& json);

/// What the page may do, as a browser is told in it and by its server.
std::string page_policy(PageKind kind);

/// One HTML file that needs no other and no network. Its security policy names the hashes of its
/// own scripts, so that nothing else in it is ever run. `title` and `data` may hold any text.
std::string page_html(const std::string& title, const Json& data, std::span<const PageBlock> blocks,
                      PageKind kind = PageKind::saved);

}  // namespace nbvopt
