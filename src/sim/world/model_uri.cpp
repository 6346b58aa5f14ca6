#include "sim/world/model_uri.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <string_view>

#include "sim/world/lower_case.hpp"

namespace nbvopt {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSchemeEnd = "://";

std::string scheme_of(const std::string& uri) {
  const std::size_t end = uri.find(kSchemeEnd);
  return end == std::string::npos ? std::string() : lower_case(uri.substr(0, end));
}

std::string decoded(const std::string& text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned char byte = 0;
    const char* from = text.data() + i + 1;
    if (text[i] == '%' && i + 2 < text.size() &&
        std::from_chars(from, from + 2, byte, 16).ptr == from + 2) {
      plain += static_cast<char>(byte);
      i += 2;
    } else {
      plain += text[i];
    }
  }
  return plain;
}

/// The path from its n-th part on.
fs::path from_part(const std::vector<fs::path>& parts, std::size_t n) {
  fs::path path;
  for (std::size_t i = n; i < parts.size(); ++i) path /= parts[i];
  return path;
}

}  // namespace

std::optional<FuelAddress> fuel_address(const std::string& uri) {
  const std::string scheme = scheme_of(uri);
  if (scheme != "https" && scheme != "http") return std::nullopt;
  const fs::path path = path_of(uri).lexically_normal();
  const std::vector<fs::path> parts(path.begin(), path.end());
  const auto models = std::ranges::find(parts, fs::path("models"));
  if (models - parts.begin() < 2 || parts.end() - models < 2) return std::nullopt;
  FuelAddress address{.host = parts.front().string(),
                      .owner = (models - 1)->string(),
                      .name = (models + 1)->string()};
  auto rest = models + 2;
  if (rest != parts.end() && *rest != "files") {
    if (*rest != "tip") address.version = rest->string();
    ++rest;
  }
  if (rest != parts.end() && *rest == "files") ++rest;
  for (; rest != parts.end(); ++rest) address.rest /= *rest;
  return address;
}

bool is_path(const std::string& uri) {
  const std::string scheme = scheme_of(uri);
  return scheme.empty() || scheme == "file";
}

fs::path path_of(const std::string& uri) {
  if (scheme_of(uri).empty()) return uri;
  return decoded(uri.substr(uri.find(kSchemeEnd) + kSchemeEnd.size()));
}

std::vector<fs::path> paths_below(const std::string& uri) {
  if (const std::optional<FuelAddress> address = fuel_address(uri)) {
    return {fs::path(address->name) / address->rest};
  }
  const fs::path whole = path_of(uri).relative_path().lexically_normal();
  const std::vector<fs::path> parts(whole.begin(), whole.end());
  std::vector<fs::path> paths{whole};
  if (scheme_of(uri) == "package") paths.push_back(from_part(parts, 1));
  const auto models = std::ranges::find(parts, fs::path("models"));
  if (models != parts.end()) {
    const auto at = static_cast<std::size_t>(models - parts.begin());
    paths.push_back(from_part(parts, at));
    paths.push_back(from_part(parts, at + 1));
  }
  std::erase_if(paths, [](const fs::path& path) { return path.empty() || path == "."; });
  return paths;
}

}  // namespace nbvopt
