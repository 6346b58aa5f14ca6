#include "sim/world/world_cache.hpp"

#include <algorithm>
#include <cstdint>
#include <iomanip>
#include <sstream>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/number.hpp"
#include "core/text_file.hpp"
#include "nbvopt/core/error.hpp"
#include "sim/world/built_world.hpp"
#include "sim/world/byte_archive.hpp"
#include "sim/world/world_names.hpp"

namespace nbvopt {

namespace {

namespace fs = std::filesystem;

/// What tells that a file was changed.
struct FileStamp {
  std::uint64_t size_bytes = 0;
  std::int64_t modified = 0;  // in ticks of the file system's clock

  bool operator==(const FileStamp&) const = default;
};

/// All zero for a file that is not there.
FileStamp stamp_of(const fs::path& file) {
  std::error_code failed;
  const std::uint64_t size_bytes = fs::file_size(file, failed);
  if (failed) return {};
  return {size_bytes, fs::last_write_time(file, failed).time_since_epoch().count()};
}

bool are_unchanged(const std::vector<std::string>& files, const std::vector<FileStamp>& stamps) {
  return std::ranges::equal(files, stamps, {},
                            [](const std::string& file) { return stamp_of(file); });
}

/// Throws InputError when the bytes are damaged.
std::optional<World> unpack(std::string_view bytes, const std::string& expected_key) {
  ArchiveReader content(bytes);
  std::string key;
  std::vector<std::string> files;
  std::vector<FileStamp> stamps;
  content(key);
  content(files);
  content(stamps);
  if (key != expected_key || !are_unchanged(files, stamps)) return std::nullopt;
  return unpack_world(content.rest());
}

}  // namespace

WorldCache::WorldCache(const fs::path& folder, const fs::path& world_file,
                       const WorldOptions& options)
    : folder_(folder) {
  const fs::path canonical = fs::weakly_canonical(world_file);
  key_ = canonical.string();
  key_ += '\n';
  key_ += enum_name(options.geometry);
  key_ += "\n" + format_number(options.mesh_unit_m);
  for (const fs::path& path : options.model_paths) {
    key_ += "\n" + fs::weakly_canonical(path).string();
  }
  std::ostringstream name;
  name << canonical.stem().string() << '-' << std::hex << std::setw(16) << std::setfill('0')
       << checksum(key_) << ".nbvworld";
  file_ = folder_ / name.str();
}

std::optional<World> WorldCache::load() const {
  std::error_code ignored;
  if (!fs::is_regular_file(file_, ignored)) return std::nullopt;
  try {
    return unpack(read_text_file(file_), key_);
  } catch (const InputError&) {
    return std::nullopt;  // built again, and replaced
  }
}

void WorldCache::store(const World& world, const std::set<fs::path>& files) const {
  std::vector<std::string> names;
  std::vector<FileStamp> stamps;
  for (const fs::path& file : files) {
    names.push_back(fs::absolute(file).string());
    stamps.push_back(stamp_of(file));
  }
  ArchiveWriter content;
  content(key_);
  content(names);
  content(stamps);
  std::error_code ignored;  // writing says why it fails
  fs::create_directories(folder_, ignored);
  write_file_atomically(file_, content.bytes() + pack_world(world));
}

}  // namespace nbvopt
