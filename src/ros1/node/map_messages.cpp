#include "ros1/node/map_messages.hpp"

#include <algorithm>
#include <functional>
#include <optional>

#include "map/map_access.hpp"
#include "map/surface_voxels.hpp"
#include "map/uncertainty_octree.hpp"
#include "nbvopt/map/colour_ramp.hpp"
#include "ros1/node/conversions.hpp"

namespace nbvopt {
namespace {

using Node = UncertaintyOcTreeNode;

std_msgs::ColorRGBA colour_message(const std::array<std::uint8_t, 3>& colour) {
  constexpr float kFull = 255.0F;
  std_msgs::ColorRGBA message;
  message.r = static_cast<float>(colour[0]) / kFull;
  message.g = static_cast<float>(colour[1]) / kFull;
  message.b = static_cast<float>(colour[2]) / kFull;
  message.a = 1.0F;
  return message;
}

/// Empty lists of cubes, one a size.
visualization_msgs::MarkerArray cube_lists(const UncertaintyMap& map) {
  visualization_msgs::MarkerArray array;
  for (int depth = 0; depth <= UncertaintyOcTree::kDepth; ++depth) {
    visualization_msgs::Marker marker;
    marker.ns = "map";
    marker.id = depth;
    marker.type = visualization_msgs::Marker::CUBE_LIST;
    marker.pose.orientation.w = 1.0;
    const double size_m = map.resolution_m() * (1 << (UncertaintyOcTree::kDepth - depth));
    marker.scale.x = marker.scale.y = marker.scale.z = size_m;
    array.markers.push_back(marker);
  }
  return array;
}

void set_actions(visualization_msgs::MarkerArray& array) {
  for (auto& marker : array.markers) {
    marker.action = marker.points.empty() ? visualization_msgs::Marker::DELETE
                                          : visualization_msgs::Marker::ADD;
  }
}

bool is_in(const HeightBand& band, const Eigen::Vector3d& centre_m) {
  return centre_m.z() >= band.min_m && centre_m.z() <= band.max_m;
}

}  // namespace

octomap_msgs::Octomap octomap_message(const std::string& file, bool is_binary,
                                      double resolution_m) {
  octomap_msgs::Octomap message;
  message.binary = is_binary ? 1 : 0;
  message.id = is_binary ? "OcTree" : "UncertaintyOcTree";
  message.resolution = resolution_m;
  // The header's last line.
  constexpr std::string_view kLastLine = "\ndata\n";
  const auto* bytes = reinterpret_cast<const std::int8_t*>(file.data());
  message.data.assign(bytes + file.find(kLastLine) + kLastLine.size(), bytes + file.size());
  return message;
}

visualization_msgs::MarkerArray occupied_cells(const UncertaintyMap& map, const HeightBand& band) {
  visualization_msgs::MarkerArray array = cube_lists(map);
  visualization_msgs::Marker& voxels = array.markers.back();
  for_each_surface_voxel(detail::MapAccess::tree(map), [&](VoxelKey voxel, const Node& leaf) {
    const Eigen::Vector3d centre_m = map.lattice().centre_m(voxel);
    if (!is_in(band, centre_m)) return true;
    voxels.points.push_back(point_message(centre_m));
    voxels.colors.push_back(colour_message(uncertainty_colour(leaf.uncertainty())));
    return true;
  });
  set_actions(array);
  return array;
}

visualization_msgs::MarkerArray free_cells(const UncertaintyMap& map) {
  visualization_msgs::MarkerArray array = cube_lists(map);
  const UncertaintyOcTree& tree = detail::MapAccess::tree(map);
  for_each_leaf(tree, [&](const Node& leaf, VoxelKey origin, int depth) {
    if (tree.isNodeOccupied(&leaf)) return;
    auto& marker = array.markers[static_cast<std::size_t>(depth)];
    const double half_m = 0.5 * (marker.scale.x - map.resolution_m());
    marker.points.push_back(
        point_message(map.lattice().centre_m(origin) + Eigen::Vector3d::Constant(half_m)));
  });
  for (auto& marker : array.markers) marker.color = colour_message({0, 255, 0});
  set_actions(array);
  return array;
}

sensor_msgs::PointCloud2 voxel_centres(const UncertaintyMap& map, const HeightBand& band) {
  sensor_msgs::PointCloud2 cloud = cloud_of_floats({"x", "y", "z", "rgb"});
  const auto append = [&](const auto& number) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(&number);
    cloud.data.insert(cloud.data.end(), bytes, bytes + sizeof(number));
  };
  for_each_surface_voxel(detail::MapAccess::tree(map), [&](VoxelKey voxel, const Node& leaf) {
    const Eigen::Vector3d centre_m = map.lattice().centre_m(voxel);
    if (!is_in(band, centre_m)) return true;
    for (const double coordinate_m : centre_m) append(static_cast<float>(coordinate_m));
    const auto [red, green, blue] = uncertainty_colour(leaf.uncertainty());
    append(std::uint32_t{red} << 16 | std::uint32_t{green} << 8 | std::uint32_t{blue});
    ++cloud.width;
    return true;
  });
  cloud.height = 1;
  cloud.row_step = cloud.width * cloud.point_step;
  cloud.is_dense = 1;
  return cloud;
}

nav_msgs::OccupancyGrid projected_map(const UncertaintyMap& map, const HeightBand& band) {
  constexpr std::int8_t kOccupied = 100;
  constexpr std::int8_t kFree = 0;
  constexpr std::int8_t kUnknown = -1;
  nav_msgs::OccupancyGrid message;
  message.info.resolution = static_cast<float>(map.resolution_m());
  message.info.origin.orientation.w = 1.0;
  const std::optional<FloorPlan> plan = floor_plan(map, band);
  if (!plan) return message;
  message.info.width = static_cast<std::uint32_t>(plan->width);
  message.info.height = static_cast<std::uint32_t>(plan->height);
  message.info.origin.position.x = plan->x_m;
  message.info.origin.position.y = plan->y_m;
  message.data.reserve(plan->pixels.size());
  // The message's first row is that of the least y, the plan's last one.
  for (int row = plan->height - 1; row >= 0; --row) {
    const auto begin = plan->pixels.begin() + std::ptrdiff_t{row} * plan->width;
    std::transform(begin, begin + plan->width, std::back_inserter(message.data), [](char pixel) {
      if (pixel == FloorPlan::kUnknown) return kUnknown;
      return pixel == FloorPlan::kOccupied ? kOccupied : kFree;
    });
  }
  return message;
}

}  // namespace nbvopt
