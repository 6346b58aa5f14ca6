#include "sim/world/built_world.hpp"

#include <array>
#include <cstdint>

#include "nbvopt/core/error.hpp"
#include "sim/people/people_json.hpp"
#include "sim/world/byte_archive.hpp"

namespace nbvopt {

namespace {

constexpr std::array<char, 8> kMagic{'n', 'b', 'v', 'w', 'o', 'r', 'l', 'd'};
/// To be raised when the format changes, or worlds are built differently from the same files.
constexpr std::uint32_t kFormatVersion = 4;

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

}  // namespace

std::string pack_world(const World& world) {
  ArchiveWriter content;
  archive_world(content, world);
  content(world.people.persons.empty() ? std::string() : to_text(to_json(world.people)));
  ArchiveWriter header;
  header(kMagic);
  header(kFormatVersion);
  header(checksum(content.bytes()));
  return header.bytes() + content.bytes();
}

World unpack_world(std::string_view bytes) {
  ArchiveReader header(bytes);
  std::array<char, 8> found_magic{};
  std::uint32_t found_version = 0;
  std::uint64_t found_checksum = 0;
  header(found_magic);
  header(found_version);
  header(found_checksum);
  if (found_magic != kMagic) throw InputError("is no built world");
  if (found_version != kFormatVersion) throw InputError("was built by another version of nbvopt");
  if (found_checksum != checksum(header.rest())) throw InputError("is damaged");
  ArchiveReader content(header.rest());
  World world;
  archive_world(content, world);
  std::string people;
  content(people);
  if (!people.empty()) world.people = people_of(parse_json(people, "the world's people"));
  return world;
}

}  // namespace nbvopt
