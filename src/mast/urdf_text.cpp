#include "mast/urdf_text.hpp"

#include <algorithm>
#include <string_view>

#include "nbvopt/core/error.hpp"
#include "nbvopt/mast/urdf.hpp"

namespace nbvopt {
namespace {

constexpr std::size_t kMostBytes = std::size_t{16} << 20;
constexpr int kDeepest = 100;  // a robot has six

/// Where a tag that starts here ends: its '>', which quotes may hold, too.
std::size_t end_of_tag(std::string_view text, std::size_t start) {
  char quote = 0;
  for (std::size_t i = start; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '>') {
      return i;
    }
  }
  return text.size();
}

/// Past whatever starts here and ends with `end`.
std::size_t skip_past(std::string_view text, std::size_t start, std::string_view end) {
  const std::size_t found = text.find(end, start);
  return found == std::string_view::npos ? text.size() : found + end.size();
}

}  // namespace

bool is_xml(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // a byte order mark
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && text[first] == '<';
}

void check_urdf_text(const std::string& text, const std::string& name) {
  if (text.size() > kMostBytes) {
    throw InputError(name + ": has " + std::to_string(text.size()) +
                     " bytes, a robot must have at most " + std::to_string(kMostBytes));
  }
  const std::string_view xml = text;
  int depth = 0;
  for (std::size_t i = xml.find('<'); i < xml.size(); i = xml.find('<', i)) {
    const std::string_view rest = xml.substr(i);
    if (rest.starts_with("<!--")) {
      i = skip_past(xml, i + 4, "-->");
    } else if (rest.starts_with("<![CDATA[")) {
      i = skip_past(xml, i, "]]>");
    } else if (rest.starts_with("<?") || rest.starts_with("<!")) {
      i = skip_past(xml, i, ">");
    } else if (rest.starts_with("</")) {
      depth = std::max(depth - 1, 0);
      i += 2;
    } else {
      if (rest.starts_with("<xacro:")) {
        throw InputError(name + ": holds macros, expand them first: xacro " + name +
                         " > expanded.urdf");
      }
      i = end_of_tag(xml, i);
      if (xml[i - 1] != '/' && ++depth > kDeepest) {
        throw InputError(name + ": is nested deeper than " + std::to_string(kDeepest) +
                         " elements, a robot must not be");
      }
    }
  }
}

}  // namespace nbvopt
