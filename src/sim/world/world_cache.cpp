#include "sim/world/world_cache.hpp"

#include <algorithm>
#include <array>
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
#include "sim/people/people_json.hpp"
#include "sim/world/byte_archive.hpp"
#include "sim/world/world_names.hpp"

namespace nbvopt {

namespace {

namespace fs = std::filesystem;

constexpr std::array<char, 8> kMagic{'n', 'b', 'v', 'w', 'o', 'r', 'l', 'd'};
/// To be raised when the format changes, or worlds are built differently from the same files.
constexpr std::uint32_t kFormatVersion = 3;

/// FNV-1a, 64 bits.
std::uint64_t checksum(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return hash;
}

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

/// The fields in their order, for reading and for writing.
template <class Archive, class AnyWorld>
void archive_world(Archive& archive, AnyWorld& world) {
  archive(world.mesh.vertices_m);
  archive(world.mesh.triangles);
  for (int axis = 0; axis < 3; ++axis) archive(world.bounds_m.min()[axis]);
  for (int axis = 0; axis < 3; ++axis) archive(world.bounds_m.max()[axis]);
  archive(world.models);
  archive(world.nested_models);
  archive(world.warnings);
  archive(world.missing);
}

bool are_unchanged(const std::vector<std::string>& files, const std::vector<FileStamp>& stamps) {
  return std::ranges::equal(files, stamps, {},
                            [](const std::string& file) { return stamp_of(file); });
}

/// Throws InputError when the bytes are damaged.
std::optional<World> unpack(std::string_view bytes, const std::string& expected_key) {
  ArchiveReader header(bytes);
  std::array<char, 8> found_magic{};
  std::uint32_t found_version = 0;
  std::uint64_t found_checksum = 0;
  header(found_magic);
  header(found_version);
  header(found_checksum);
  if (found_magic != kMagic || found_version != kFormatVersion) return std::nullopt;
  if (found_checksum != checksum(header.rest())) return std::nullopt;

  ArchiveReader content(header.rest());
  std::string key;
  std::vector<std::string> files;
  std::vector<FileStamp> stamps;
  content(key);
  content(files);
  content(stamps);
  if (key != expected_key || !are_unchanged(files, stamps)) return std::nullopt;
  World world;
  archive_world(content, world);
  std::string people;
  content(people);
  if (!people.empty()) world.people = people_of(parse_json(people, "the world's people"));
  return world;
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
  archive_world(content, world);
  content(world.people.persons.empty() ? std::string() : to_text(to_json(world.people)));
  ArchiveWriter header;
  header(kMagic);
  header(kFormatVersion);
  header(checksum(content.bytes()));

  std::error_code ignored;  // writing says why it fails
  fs::create_directories(folder_, ignored);
  write_file_atomically(file_, header.bytes() + content.bytes());
}

}  // namespace nbvopt
