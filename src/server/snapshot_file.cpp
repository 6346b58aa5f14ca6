#include "server/snapshot_file.hpp"

#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

#include "core/atomic_file.hpp"
#include "core/input_file.hpp"
#include "map/whole_number.hpp"
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
  in.clear();
  in.seekg(0);
  return Snapshot{read_map(in, path.string()), version};
}

void write_snapshot(const fs::path& path, const MapBytes& map) {
  const std::size_t second_line = map.bytes.find('\n') + 1;
  std::string bytes = map.bytes;
  bytes.insert(second_line, std::string(kVersionComment) + std::to_string(map.version) + '\n');
  write_file_atomically(path, bytes);
}

}  // namespace nbvopt
