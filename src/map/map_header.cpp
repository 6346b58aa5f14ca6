#include "map/map_header.hpp"

#include <cmath>
#include <cstring>
#include <sstream>

#include "core/number.hpp"
#include "map/other_formats.hpp"
#include "map/whole_number.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

[[noreturn]] void refuse(const std::string& name, const std::string& what) {
  throw InputError(name + ": " + what);
}

constexpr const char* kNotAMap = "this is not an OctoMap file (.bt or .ot)";

bool is_resolution(double metres) { return metres > 0.0 && std::isfinite(metres); }

/// The header of .bt files of OctoMap before 1.0: three numbers, the first always this one.
constexpr std::int32_t kOldTreeType = 3;

bool is_old_header(ByteReader& in) {
  const char* bytes = in.peek(sizeof kOldTreeType);
  return bytes != nullptr && number_at<std::int32_t>(bytes) == kOldTreeType;
}

MapHeader read_old_header(ByteReader& in, const std::string& name) {
  in.take(sizeof kOldTreeType);
  const char* bytes = in.take(sizeof(double) + sizeof(std::uint32_t));
  if (bytes == nullptr) refuse(name, "the file ends in its header, it is truncated");
  MapHeader header;
  header.is_binary = true;
  header.tree_type = "OcTree";
  header.resolution_m = number_at<double>(bytes);
  header.nodes = number_at<std::uint32_t>(bytes + sizeof(double));
  if (!is_resolution(header.resolution_m)) {
    refuse(name, kNotAMap);
  }
  return header;
}

/// One that may be left out, since the nodes themselves say where they end. So is 0 where nodes
/// follow: some programs write the header before they know.
void check_node_count(MapHeader& header, const std::string& written, ByteReader& in,
                      std::vector<std::string>& warnings) {
  const bool is_placeholder = header.nodes == 0 && !in.at_end();
  if (header.nodes && !is_placeholder) return;
  header.nodes.reset();
  warnings.push_back("the header " +
                     (written.empty() ? "has no 'size'" : "says 'size " + written + "'") +
                     ", which is no number of nodes: all that follow were read");
}

}  // namespace

MapHeader read_map_header(ByteReader& in, const std::string& name,
                          std::vector<std::string>& warnings) {
  constexpr std::size_t kMaxLine = 1024;
  constexpr int kMaxLines = 1000;
  if (is_old_header(in)) return read_old_header(in, name);
  MapHeader header;
  header.is_binary = in.begins_with(kBinaryMagic);
  if (!header.is_binary && !in.begins_with(kFullMagic)) {
    refuse(name, std::string(kNotAMap) + "; " + what_else(in));
  }

  std::string size;
  in.take_line(kMaxLine);
  for (int i = 0; i < kMaxLines; ++i) {
    const auto line = in.take_line(kMaxLine);
    if (!line) refuse(name, "the header has no line 'data', the file is truncated or damaged");
    std::istringstream words(*line);
    std::string key;
    std::string value;
    words >> key >> value;
    if (key == "data") {
      // All .bt files are alike, whatever wrote them.
      if (header.tree_type.empty() && !header.is_binary) refuse(name, "the header has no 'id'");
      if (!is_resolution(header.resolution_m)) {
        refuse(name,
               "the header's 'res' must be there, positive and finite: the edge of a voxel in m");
      }
      check_node_count(header, size, in, warnings);
      return header;
    }
    if (key == "id") header.tree_type = value;
    if (key == "size") {
      size = value.substr(0, 40);
      header.nodes = parse_whole_number(value);
    }
    if (key == "res" || key == "resolution") {
      header.resolution_m = parse_number(value).value_or(0.0);
    }
  }
  refuse(name, "the header has too many lines, the file is damaged");
}

std::string map_file_header(const char* magic, const char* tree_type, std::uint64_t nodes,
                            double resolution_m) {
  return std::string(magic) +
         "\n# (feel free to add / change comments, but leave the first line as it is!)\n#\n"
         "id " +
         tree_type + "\nsize " + std::to_string(nodes) + "\nres " + format_number(resolution_m) +
         "\ndata\n";
}

}  // namespace nbvopt
