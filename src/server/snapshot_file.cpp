#include "server/snapshot_file.hpp"

#include <fstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/input_file.hpp"
#include "map/whole_number.hpp"
#include "nbvopt/gain/hazard_file.hpp"
#include "nbvopt/map/map_file.hpp"

namespace nbvopt {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kVersionComment = "# nbvopt map_version ";

/// The version that the second line tells.
std::uint64_t stored_version(std::istream& in) {
  std::string line;
  std::getline(in, line);
  std::getline(in, line);
  if (!line.starts_with(kVersionComment)) return 1;
  return parse_whole_number(line.substr(kVersionComment.size())).value_or(1);
}

}  // namespace

std::optional<Snapshot> read_snapshot(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error) && !error) return {};
  std::ifstream in = open_input_file(path);
  const std::uint64_t version = stored_version(in);
  const auto from_the_start = [&]() -> std::istream& {
    in.clear();
    return in.seekg(0);
  };
  auto hazards = hazards_in_header(from_the_start(), path.string());
  return Snapshot{read_map(from_the_start(), path.string()), version, std::move(hazards)};
}

void write_snapshot(const fs::path& path, const MapBytes& map) {
  std::string comments = std::string(kVersionComment) + std::to_string(map.version) + '\n';
  if (map.hazards) comments += hazards_comment(*map.hazards);
  std::vector<std::string_view> pieces = map.bytes.views();
  const std::string_view first = pieces.front();
  const std::size_t line_end = first.find('\n') + 1;
  pieces.front() = first.substr(line_end);
  pieces.insert(pieces.begin(), {first.substr(0, line_end), comments});
  write_file_atomically(path, pieces);
}

}  // namespace nbvopt
