#include "cli/map_output.hpp"

#include <array>
#include <cstdio>
#include <utility>

#include "core/number.hpp"

namespace nbvopt {
namespace {

/// A number for people.
std::string rounded(double value, int digits) {
  std::array<char, 64> text;
  std::snprintf(text.data(), text.size(), "%.*f", digits, value);
  return text.data();
}

/// The known box in the map frame: its least and its greatest corner.
std::pair<Eigen::Vector3d, Eigen::Vector3d> corners_m(const Lattice& lattice, const KeyBox& box) {
  const Eigen::Vector3d half_voxel_m = Eigen::Vector3d::Constant(lattice.resolution_m() / 2.0);
  return {lattice.centre_m(box.min) - half_voxel_m, lattice.centre_m(box.max) + half_voxel_m};
}

Json point_json(const Eigen::Vector3d& p_map_m) { return {p_map_m.x(), p_map_m.y(), p_map_m.z()}; }

}  // namespace

Json map_json(const UncertaintyMap& map) {
  const MapCounts counts = map.counts();
  Json json{{"resolution_m", map.resolution_m()},
            {"occupied_voxels", counts.occupied_voxels},
            {"free_voxels", counts.free_voxels},
            {"certain_voxels", counts.certain_voxels},
            {"information", counts.information},
            {"carries_uncertainty", counts.certain_voxels > 0},
            {"leaves", counts.leaves},
            {"nodes", counts.nodes},
            {"min_m", nullptr},
            {"max_m", nullptr}};
  if (const auto box = map.known_box()) {
    const auto [min_m, max_m] = corners_m(map.lattice(), *box);
    json["min_m"] = point_json(min_m);
    json["max_m"] = point_json(max_m);
  }
  return json;
}

std::string map_text(const UncertaintyMap& map) {
  const MapCounts counts = map.counts();
  std::string text = "resolution         " + format_number(map.resolution_m()) +
                     " m\noccupied voxels    " + std::to_string(counts.occupied_voxels) +
                     "\nfree voxels        " + std::to_string(counts.free_voxels) +
                     "\noccupied with u<1  " + std::to_string(counts.certain_voxels) +
                     "\ninformation        " + rounded(counts.information, 1) +
                     (counts.certain_voxels > 0 ? "" : "  (the map carries no uncertainty)") +
                     "\nleaves, nodes      " + std::to_string(counts.leaves) + ", " +
                     std::to_string(counts.nodes) + "\n";
  if (const auto box = map.known_box()) {
    const auto [min_m, max_m] = corners_m(map.lattice(), *box);
    text += "known box          ";
    for (int axis = 0; axis < 3; ++axis) {
      text += (axis == 0 ? "" : ", ") + rounded(min_m[axis], 2) + " to " + rounded(max_m[axis], 2);
    }
    text += " m\n";
  }
  return text;
}

}  // namespace nbvopt
