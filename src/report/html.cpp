#include "report/html.hpp"

#include "core/base64.hpp"
#include "core/html_text.hpp"

namespace nbvopt {

std::string to_html(const TextTable& table) {
  const auto row = [&](const char* tag, const auto& text_of) {
    std::string html = "<tr>";
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      if (table.columns[i].heading.empty()) continue;
      const bool is_text = !table.rows.empty() && is_text_cell(table.rows.front()[i]);
      html += std::string("<") + tag + (is_text ? " class=\"text\">" : ">") +
              html_escaped(text_of(i)) + "</" + tag + ">";
    }
    return html + "</tr>\n";
  };
  std::string html =
      "<table>\n" + row("th", [&](std::size_t i) { return table.columns[i].heading; });
  for (const std::vector<TableCell>& cells : table.rows) {
    html += row("td", [&](std::size_t i) { return shown(cells[i], table.columns[i]); });
  }
  return html + "</table>\n";
}

std::string html_image(std::string_view png, std::string_view meaning) {
  return "<img alt=\"" + html_escaped(meaning) + "\" src=\"data:image/png;base64," + base64(png) +
         "\">\n";
}

}  // namespace nbvopt
