#include "web/page.hpp"

#include <charconv>
#include <stdexcept>
#include <string_view>

#include "core/base64.hpp"
#include "core/html_text.hpp"
#include "web/page_parts.hpp"

namespace nbvopt {
namespace {

constexpr std::string_view kStyle = "view.css";

bool is_script(const PagePart& part) { return part.name.ends_with(".js"); }

const PagePart& part(std::string_view name) {
  for (const PagePart& part : page_parts()) {
    if (part.name == name) return part;
  }
  throw std::logic_error("the page lacks " + std::string(name));
}

/// The hash as a security policy writes it.
std::string policy_hash(const PagePart& part) {
  std::string bytes;
  for (std::size_t i = 0; i < part.sha256_hex.size(); i += 2) {
    unsigned value = 0;
    std::from_chars(part.sha256_hex.data() + i, part.sha256_hex.data() + i + 2, value, 16);
    bytes += static_cast<char>(value);
  }
  return "'sha256-" + base64(bytes) + "'";
}

std::string scripts() {
  std::string html;
  for (const PagePart& part : page_parts()) {
    if (is_script(part)) html.append("<script>").append(part.content).append("</script>\n");
  }
  return html;
}

/// What is not run but read by scripts.
std::string data_element(const std::string& id, const std::string& text) {
  return "<script type=\"text/plain\" id=\"" + html_escaped(id) + "\">" + text + "</script>\n";
}

/// JSON in which nothing ends the element that it stands in: a < is in strings alone.
std::string json_in_html(const Json& data) {
  std::string text;
  for (const char letter : line_of(data)) {
    if (letter == '<') {
      text += "\\u003c";
    } else {
      text += letter;
    }
  }
  return text;
}

}  // namespace

std::string line_of(const Json& json) {
  return json.dump(-1, ' ', true, Json::error_handler_t::replace);
}

std::string page_policy(PageKind kind) {
  std::string scripts;
  for (const PagePart& part : page_parts()) {
    if (is_script(part)) scripts += " " + policy_hash(part);
  }
  return "default-src 'none'; script-src" + scripts + "; style-src " + policy_hash(part(kStyle)) +
         "; img-src data:; base-uri 'none'; form-action 'none'" +
         (kind == PageKind::live ? "; connect-src 'self'" : "");
}

std::string page_html(const std::string& title, const Json& data, std::span<const PageBlock> blocks,
                      PageKind kind) {
  const auto filling = [&](std::string_view name) -> std::string {
    if (name == "title") return html_escaped(title);
    if (name == "policy") return page_policy(kind);
    if (name == "style") return "<style>" + std::string(part(kStyle).content) + "</style>";
    if (name == "scripts") return scripts();
    if (name != "data") throw std::logic_error("the page has no " + std::string(name));
    std::string elements = data_element("data", json_in_html(data));
    for (const PageBlock& block : blocks) elements += data_element(block.id, block.base64);
    return elements;
  };
  // The frame's marks, {{name}}, are filled once: what they are filled with is not looked at.
  std::string html;
  std::string_view frame = part("view.html").content;
  for (auto mark = frame.find("{{"); mark != frame.npos; mark = frame.find("{{")) {
    const auto end = frame.find("}}", mark);
    html.append(frame.substr(0, mark)).append(filling(frame.substr(mark + 2, end - mark - 2)));
    frame.remove_prefix(end + 2);
  }
  return html.append(frame);
}

}  // namespace nbvopt
