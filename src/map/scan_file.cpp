#include "nbvopt/map/scan_file.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>

#include "core/input_file.hpp"
#include "map/point_records.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {

namespace {

constexpr std::array<std::string_view, 10> kPcdWords{"version", "fields",   "columns", "size",
                                                     "type",    "count",    "width",   "height",
                                                     "points",  "viewpoint"};

/// What the first character alone tells.
std::string word_of_pipe(int first) {
  switch (first) {
    case 'p':
      return "ply";
    case 'P':
      return "p5";
    case '#':
    case 'V':
    case 'F':
      return "version";
    default:
      return "";
  }
}

/// The first word that is no comment, in lower case; the stream is then at its start again.
std::string first_word(std::istream& in, const std::string& name) {
  const auto start = in.tellg();
  if (start < 0) {  // a pipe cannot go back
    in.clear();
    return word_of_pipe(in.peek());
  }
  ScanInput lines(in, name);
  std::string word;
  while (const auto line = lines.next_line()) {
    word = lower_case(std::string(Words(*line).next()));
    if (!word.starts_with('#')) break;
  }
  in.clear();
  in.seekg(start);
  return word;
}

}  // namespace

Scan read_scan(const std::filesystem::path& path,
               const std::optional<DepthImageOptions>& depth_image) {
  std::ifstream in = open_input_file(path);
  return read_scan(in, path.string(), depth_image);
}

Scan read_scan(std::istream& in, const std::string& name,
               const std::optional<DepthImageOptions>& depth_image) {
  const auto camera = [&] {
    if (!depth_image) throw InputError(name + ": a depth image needs the camera's intrinsics");
    return *depth_image;
  };
  if (in.peek() == 0x89) return read_depth_png(in, name, camera());
  const std::string word = first_word(in, name);
  if (word == "ply") return read_ply(in, name);
  if (word == "p2" || word == "p5") return read_depth_pgm(in, name, camera());
  if (word.starts_with('#') || std::ranges::count(kPcdWords, word)) return read_pcd(in, name);
  return read_xyz(in, name);
}

}  // namespace nbvopt
