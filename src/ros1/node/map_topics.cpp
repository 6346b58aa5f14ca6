#include "ros1/node/map_topics.hpp"

#include <algorithm>
#include <sstream>
#include <type_traits>

#include "nbvopt/map/map_file.hpp"
#include "ros1/node/map_messages.hpp"

namespace nbvopt {
namespace {

/// A message without a header of its own has one in each of its markers.
template <class Message>
void set_header(Message& message, const std_msgs::Header& header) {
  if constexpr (std::is_same_v<Message, visualization_msgs::MarkerArray>) {
    for (auto& marker : message.markers) marker.header = header;
  } else {
    message.header = header;
  }
}

}  // namespace

template <class Message>
void MapTopics::add(ros::NodeHandle& node, const std::string& name,
                    std::function<Message(const UncertaintyMap&)> make) {
  constexpr bool kIsLatched = true;
  topics_.push_back({.publisher = node.advertise<Message>(name, 1, kIsLatched),
                     .publish = [make](const ros::Publisher& publisher, const UncertaintyMap& map,
                                       const std_msgs::Header& header) {
                       Message message = make(map);
                       set_header(message, header);
                       publisher.publish(message);
                     }});
}

MapTopics::MapTopics(ros::NodeHandle& node, const NodeParameters& parameters, const MapStore& store)
    : store_(store), map_frame_(parameters.map_frame) {
  for (const auto& [name, format] : {std::pair{"octomap_full", MapFormat::uncertainty_ot},
                                     std::pair{"octomap_binary", MapFormat::bt}}) {
    add<octomap_msgs::Octomap>(node, name, [format = format](const UncertaintyMap& map) {
      return octomap_message(map_file_bytes(map, format), format == MapFormat::bt,
                             map.resolution_m());
    });
  }
  const HeightBand band = parameters.shown_band;
  add<visualization_msgs::MarkerArray>(
      node, "occupied_cells_vis_array",
      [band](const UncertaintyMap& map) { return occupied_cells(map, band); });
  if (parameters.publishes_free_space) {
    add<visualization_msgs::MarkerArray>(node, "free_cells_vis_array", free_cells);
  }
  add<sensor_msgs::PointCloud2>(
      node, "octomap_point_cloud_centers",
      [band](const UncertaintyMap& map) { return voxel_centres(map, band); });
  add<nav_msgs::OccupancyGrid>(node, "projected_map", [band](const UncertaintyMap& map) {
    return projected_map(map, band);
  });
  timer_ = node.createWallTimer(ros::WallDuration(parameters.publish_period_s),
                                [this](const ros::WallTimerEvent&) { publish(); });
}

void MapTopics::publish() {
  const std::uint64_t version = store_.published()->map_version();
  const auto is_due = [&](const Topic& topic) {
    return topic.version < version && topic.publisher.getNumSubscribers() > 0;
  };
  if (std::ranges::none_of(topics_, is_due)) return;
  // A copy, so that no scan waits for the messages.
  const auto copy = store_.bytes(MapFormat::uncertainty_ot);
  std::istringstream file(copy->bytes.joined());
  const UncertaintyMap map = read_map(file, "the map");
  std_msgs::Header header;
  header.frame_id = map_frame_;
  header.stamp = ros::Time::now();
  for (Topic& topic : topics_) {
    if (!is_due(topic)) continue;
    try {
      topic.publish(topic.publisher, map, header);
    } catch (const std::exception& error) {
      ROS_WARN("%s: %s", topic.publisher.getTopic().c_str(), error.what());
    }
    topic.version = copy->version;
  }
}

}  // namespace nbvopt
