#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "core/input_file.hpp"
#include "core/number.hpp"
#include "map/byte_reader.hpp"
#include "map/gunzip_stream.hpp"
#include "map/map_header.hpp"
#include "map/tree_reader.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/map_file.hpp"

namespace nbvopt {
namespace {

UncertaintyMap map_of(ByteReader& in, const std::string& name, const MapHeader& header,
                      std::vector<std::string>& warnings) {
  const bool is_plain = header.is_binary || header.tree_type != kUncertaintyType;
  return UncertaintyMap(read_tree(in, name, header, warnings), is_plain);
}

UncertaintyMap read_unpacked(std::istream& in, const std::string& name,
                             std::vector<std::string>& warnings) {
  ByteReader reader(in);
  const MapHeader header = read_map_header(reader, name, warnings);
  return map_of(reader, name, header, warnings);
}

}  // namespace

UncertaintyMap read_map(std::istream& in, const std::string& name,
                        std::vector<std::string>& warnings) {
  if (!is_gzip(in)) return read_unpacked(in, name, warnings);
  GunzipStream unpacked(in, name);
  UncertaintyMap map = read_unpacked(unpacked, name, warnings);
  while (unpacked.ignore(1 << 20)) continue;  // the checksum comes last
  return map;
}

UncertaintyMap read_map(std::istream& in, const std::string& name) {
  std::vector<std::string> warnings;
  return read_map(in, name, warnings);
}

UncertaintyMap read_map(const std::filesystem::path& path, std::vector<std::string>& warnings) {
  std::ifstream in = open_input_file(path);
  return read_map(in, path.string(), warnings);
}

UncertaintyMap read_map(const std::filesystem::path& path) {
  std::vector<std::string> warnings;
  return read_map(path, warnings);
}

UncertaintyMap read_map_message(std::istream& in, const std::string& name,
                                const MapMessage& message, std::vector<std::string>& warnings) {
  if (!(message.resolution_m > 0.0) || !std::isfinite(message.resolution_m)) {
    throw InputError("the message's resolution is " + format_number(message.resolution_m) +
                     " m, it must be positive and finite");
  }
  ByteReader reader(in);
  MapHeader header;
  header.is_binary = message.is_binary;
  header.tree_type = message.tree_type;
  header.resolution_m = message.resolution_m;
  UncertaintyMap map = map_of(reader, name, header, warnings);
  if (!reader.at_end()) {
    throw InputError(name + ": bytes are left after the tree: are type '" + message.tree_type +
                     "' and " + (message.is_binary ? "binary" : "full") +
                     " what the message says?");
  }
  return map;
}

UncertaintyMap read_map_message(const std::filesystem::path& path, const MapMessage& message,
                                std::vector<std::string>& warnings) {
  std::ifstream in = open_input_file(path);
  return read_map_message(in, path.string(), message, warnings);
}

}  // namespace nbvopt
