#include "ros1/node/map_services.hpp"

#include <cmath>
#include <functional>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/gain/named_evaluator.hpp"
#include "ros1/node/box_value.hpp"
#include "ros1/node/conversions.hpp"
#include "ros1/node/map_messages.hpp"

namespace nbvopt {
namespace {

double half_angle(const std::string& name, float min_rad, float max_rad) {
  constexpr double kTolerance_rad = 1e-3;
  if (std::abs(double{min_rad} + max_rad) <= kTolerance_rad) return max_rad;
  throw InputError(name + "_min and " + name + "_max are " + format_number(double{min_rad}) +
                   " and " + format_number(double{max_rad}) + " rad, they must lie evenly about 0");
}

int ray_count(const std::string& name, float value) {
  if (value >= 1.0F && value <= 10'000.0F && value == std::floor(value)) {
    return static_cast<int>(value);
  }
  throw InputError(name + " is " + format_number(double{value}) +
                   ", it must be a whole number from 1 to 10000");
}

/// The robot's sensor with the rays that a client asks for.
SensorOptions sensor_of(const octomap_msgs::EstimateGain::Request& request, SensorOptions sensor) {
  sensor.horizontal_rays = ray_count("h_res", request.h_res);
  sensor.vertical_rays = ray_count("v_res", request.v_res);
  constexpr int kMostRays = 4'000'000;
  if (std::int64_t{sensor.horizontal_rays} * sensor.vertical_rays > kMostRays) {
    throw InputError("h_res times v_res is more than " + std::to_string(kMostRays) + " rays");
  }
  sensor.half_fov_horizontal_rad = half_angle("angle_h", request.angle_h_min, request.angle_h_max);
  sensor.half_fov_vertical_rad = half_angle("angle_v", request.angle_v_min, request.angle_v_max);
  sensor.range_min_m = request.range_min;
  sensor.range_max_m = request.range_max;
  sensor.validate();
  return sensor;
}

}  // namespace

template <class Request, class Response, class Answer>
void MapServices::advertise(ros::NodeHandle& node, const std::string& name, const Answer& answer) {
  const std::function<bool(Request&, Response&)> callback = [answer](Request& request,
                                                                     Response& response) {
    answer(request, response);
    return true;
  };
  servers_.push_back(node.advertiseService<Request, Response>(name, callback));
}

MapServices::MapServices(ros::NodeHandle& node, ros::NodeHandle& private_node,
                         const NodeParameters& parameters, const tf2_ros::Buffer& tf,
                         MapStore& store)
    : parameters_(parameters), tf_(tf), store_(store) {
  using octomap_msgs::BoundingBoxQuery;
  using octomap_msgs::EstimateGain;
  using octomap_msgs::GetAABBoxValue;
  using octomap_msgs::GetOctomap;
  using octomap_msgs::GetValue;
  advertise<EstimateGain::Request, EstimateGain::Response>(
      private_node, "estimate_gain",
      [this](auto& request, auto& response) { estimate_gain(request, response); });
  // Only occupied voxels carry information: both values are the same.
  advertise<GetValue::Request, GetValue::Response>(
      private_node, "get_map_info", [this](auto&, auto& response) {
        response.value = static_cast<float>(store_.counts().counts.information);
        response.value_occupied = response.value;
      });
  advertise<GetValue::Request, GetValue::Response>(
      private_node, "get_map_voxels", [this](auto&, auto& response) {
        response.value = static_cast<float>(store_.counts().counts.certain_voxels);
        response.value_occupied = response.value;
      });
  for (const bool is_gain : {false, true}) {
    advertise<GetAABBoxValue::Request, GetAABBoxValue::Response>(
        private_node, is_gain ? "get_AABBox_gain" : "get_AABBox_info",
        [this, is_gain](auto& request, auto& response) { box_value(request, response, is_gain); });
  }
  advertise<BoundingBoxQuery::Request, BoundingBoxQuery::Response>(
      private_node, "clear_bbx", [this](auto& request, auto&) {
        const Lattice lattice = store_.published()->grid()->lattice();
        store_.clear_box(key_box(lattice, point_of(request.min), point_of(request.max)));
      });
  advertise<std_srvs::Empty::Request, std_srvs::Empty::Response>(
      private_node, "reset", [this](auto&, auto&) { store_.clear(std::nullopt); });
  for (const bool is_binary : {false, true}) {
    advertise<GetOctomap::Request, GetOctomap::Response>(
        node, is_binary ? "octomap_binary" : "octomap_full",
        [this, is_binary](auto&, auto& response) { get_octomap(response, is_binary); });
  }
}

void MapServices::estimate_gain(const octomap_msgs::EstimateGain::Request& request,
                                octomap_msgs::EstimateGain::Response& response) const {
  const SensorOptions sensor = sensor_of(request, parameters_.robot.sensor);
  Transform T_map_sensor = transform_of(request.pose.pose);
  if (const std::string& frame = request.pose.header.frame_id;
      !frame.empty() && frame != parameters_.map_frame) {
    T_map_sensor =
        look_up(tf_, parameters_.map_frame, frame, request.pose.header.stamp) * T_map_sensor;
  }
  const std::shared_ptr<const ViewPlanner> planner = store_.published();
  const ViewGain view =
      make_exact_evaluator(planner->grid(), DepthCamera(sensor), planner->hazards())
          ->evaluate(T_map_sensor);
  response.gain = static_cast<float>(view.occupied_gain +
                                     double{request.unknown_gain_value} * view.unknown_gain);
  response.unknown_cells = view.unknown_rays;
}

void MapServices::box_value(const octomap_msgs::GetAABBoxValue::Request& request,
                            octomap_msgs::GetAABBoxValue::Response& response, bool is_gain) const {
  const auto grid = store_.published()->grid();
  const BoxValue value = nbvopt::box_value(
      *grid, key_box(grid->lattice(), point_of(request.min), point_of(request.max)),
      parameters_.robot.sensor.occupied_uncertainty);
  response.value =
      static_cast<float>((is_gain ? value.uncertainty : value.information) +
                         double{request.unknown_cell_value} * static_cast<double>(value.unknown));
}

void MapServices::get_octomap(octomap_msgs::GetOctomap::Response& response, bool is_binary) const {
  const auto bytes = store_.bytes(is_binary ? MapFormat::bt : MapFormat::uncertainty_ot);
  response.map = octomap_message(bytes->bytes.joined(), is_binary,
                                 store_.published()->grid()->lattice().resolution_m());
  response.map.header.frame_id = parameters_.map_frame;
  response.map.header.stamp = ros::Time::now();
}

}  // namespace nbvopt
