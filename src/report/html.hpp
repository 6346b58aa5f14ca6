// Tables and pictures within a page.
#pragma once

#include <string>
#include <string_view>

#include "report/text_table.hpp"

namespace nbvopt {

/// A table as people see it; columns whose first cell is text stand to the left.
std::string to_html(const TextTable& table);

/// A PNG picture that stands within the page, with its meaning for those who do not see it.
std::string html_image(std::string_view png, std::string_view meaning);

}  // namespace nbvopt
