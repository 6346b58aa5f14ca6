#include "nbvopt/map/floor_plan.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "core/atomic_file.hpp"
#include "core/number.hpp"
#include "map/map_access.hpp"
#include "map/uncertainty_octree.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

using Node = UncertaintyOcTreeNode;

constexpr const char* kThresholds = "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";

constexpr std::uint64_t kMostPixels = 100'000'000;

/// Columns of voxels, both ends included.
struct Columns {
  int min_x, min_y, max_x, max_y;

  void add(const Columns& other) {
    min_x = std::min(min_x, other.min_x);
    min_y = std::min(min_y, other.min_y);
    max_x = std::max(max_x, other.max_x);
    max_y = std::max(max_y, other.max_y);
  }
  int width() const { return max_x - min_x + 1; }
  int height() const { return max_y - min_y + 1; }
};

/// Calls visit(leaf, its columns) for the leaves that the band cuts.
template <class Visit>
void for_each_leaf_in_band(const UncertaintyMap& map, const HeightBand& band, const Visit& visit) {
  const Lattice& lattice = map.lattice();
  const auto centre_z_m = [&](int z) {
    return (z - Lattice::kKeyOfOrigin + 0.5) * lattice.resolution_m();
  };
  for_each_leaf(detail::MapAccess::tree(map), [&](const Node& leaf, VoxelKey origin, int depth) {
    const int size = 1 << (UncertaintyOcTree::kDepth - depth);
    // The layers of the leaf whose centres lie in the band: any?
    const double first =
        std::ceil(band.min_m / lattice.resolution_m() + Lattice::kKeyOfOrigin - 0.5);
    const int lowest = first > origin.z ? static_cast<int>(std::min(first, 65536.0)) : origin.z;
    if (lowest >= origin.z + size || centre_z_m(lowest) > band.max_m) return;
    visit(leaf, Columns{origin.x, origin.y, origin.x + size - 1, origin.y + size - 1});
  });
}

std::string pixels_of(const UncertaintyMap& map, const HeightBand& band, const Columns& shown) {
  constexpr char kOccupied = FloorPlan::kOccupied, kFree = FloorPlan::kFree;
  constexpr char kUnknown = FloorPlan::kUnknown;
  std::string pixels(
      static_cast<std::size_t>(shown.width()) * static_cast<std::size_t>(shown.height()), kUnknown);
  const UncertaintyOcTree& tree = detail::MapAccess::tree(map);
  for_each_leaf_in_band(map, band, [&](const Node& leaf, const Columns& columns) {
    const bool is_occupied = tree.isNodeOccupied(&leaf);
    for (int y = columns.min_y; y <= columns.max_y; ++y) {
      const auto row = static_cast<std::size_t>(shown.max_y - y);  // the first is the farthest
      char* pixel = &pixels[row * static_cast<std::size_t>(shown.width()) +
                            static_cast<std::size_t>(columns.min_x - shown.min_x)];
      for (int x = columns.min_x; x <= columns.max_x; ++x, ++pixel) {
        if (is_occupied || *pixel == kUnknown) *pixel = is_occupied ? kOccupied : kFree;
      }
    }
  });
  return pixels;
}

std::string picture(const FloorPlan& plan) {
  return "P5\n" + std::to_string(plan.width) + " " + std::to_string(plan.height) + "\n255\n" +
         plan.pixels;
}

/// As YAML wants names that may hold its signs.
std::string quoted(const std::string& name) {
  std::string text = "'";
  for (const char c : name) text += c == '\'' ? std::string("''") : std::string(1, c);
  return text + "'";
}

std::string meaning(const FloorPlan& plan, const std::string& picture_name) {
  return "image: " + quoted(picture_name) +
         "\nmode: trinary\nresolution: " + format_number(plan.resolution_m) + "\norigin: [" +
         format_number(plan.x_m) + ", " + format_number(plan.y_m) + ", 0]\n" + kThresholds;
}

/// A picture beside the meaning of another would look right: an older meaning is put aside until
/// the picture stands, and comes back if it cannot be written.
void write_pair(const std::filesystem::path& picture_path, const std::string& picture,
                const std::filesystem::path& meaning_path, const std::string& meaning) {
  auto aside = meaning_path;
  aside += ".replaced";
  const bool is_replaced = std::filesystem::is_regular_file(meaning_path);
  if (is_replaced) std::filesystem::rename(meaning_path, aside);
  try {
    write_file_atomically(picture_path, picture);
  } catch (const InputError&) {
    if (is_replaced) std::filesystem::rename(aside, meaning_path);
    throw;
  }
  write_file_atomically(meaning_path, meaning);
  if (is_replaced) std::filesystem::remove(aside);
}

}  // namespace

std::optional<FloorPlan> floor_plan(const UncertaintyMap& map, const HeightBand& band) {
  if (!(band.min_m <= band.max_m)) {
    throw InputError("height band: its lower end, " + format_number(band.min_m) +
                     " m, must be at most the upper, " + format_number(band.max_m) + " m");
  }
  std::optional<Columns> shown;
  for_each_leaf_in_band(map, band, [&](const Node&, const Columns& columns) {
    if (!shown) shown = columns;
    shown->add(columns);
  });
  if (!shown) return std::nullopt;
  const std::uint64_t pixels =
      static_cast<std::uint64_t>(shown->width()) * static_cast<std::uint64_t>(shown->height());
  if (pixels > kMostPixels) {
    throw InputError("floor plan: " + std::to_string(shown->width()) + " x " +
                     std::to_string(shown->height()) + " pixels, more than the " +
                     std::to_string(kMostPixels) +
                     " that are written: narrow the height band, or use coarser voxels");
  }
  const double resolution_m = map.resolution_m();
  return FloorPlan{.width = shown->width(),
                   .height = shown->height(),
                   .resolution_m = resolution_m,
                   .x_m = (shown->min_x - Lattice::kKeyOfOrigin) * resolution_m,
                   .y_m = (shown->min_y - Lattice::kKeyOfOrigin) * resolution_m,
                   .pixels = pixels_of(map, band, *shown)};
}

void write_floor_plan(const UncertaintyMap& map, const std::filesystem::path& path,
                      const HeightBand& band) {
  const std::optional<FloorPlan> plan = floor_plan(map, band);
  if (!plan) throw InputError("floor plan: nothing is known in the height band");
  auto picture_path = path;
  auto meaning_path = path;
  picture_path.replace_extension(".pgm");
  meaning_path.replace_extension(".yaml");
  require_writable(meaning_path);
  write_pair(picture_path, picture(*plan), meaning_path,
             meaning(*plan, picture_path.filename().string()));
}

}  // namespace nbvopt
