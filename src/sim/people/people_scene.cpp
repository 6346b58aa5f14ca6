#include "sim/people/people_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <tuple>

#include "nbvopt/core/error.hpp"
#include "sim/people/body.hpp"
#include "sim/ray_packets.hpp"

namespace nbvopt {

/// Owns Embree's handles. A body is a scene of its own with three round segments, whose legs are
/// bent as he walks; an instance of it stands where he does.
struct PeopleScene::Embree {
  explicit Embree(std::size_t count) : device(new_embree_device(error)), all(rtcNewScene(device)) {
    rtcSetSceneFlags(all, RTC_SCENE_FLAG_DYNAMIC);
    for (std::size_t i = 0; i < count; ++i) bodies.push_back(new_body());
    if (!error.empty()) {
      release();
      throw Error("Embree cannot build people: " + error);
    }
  }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;
  ~Embree() { release(); }

  struct Body {
    RTCScene scene;
    RTCGeometry segments;
    RTCGeometry instance;
    float* vertices;  ///< x, y, z and radius of each end
  };

  void place(const Body& body, const BodyPose& pose) const {
    float* to = body.vertices;
    const auto add_end = [&to](const Eigen::Vector3d& end_m, double radius_m) {
      const Eigen::Vector4f vertex =
          (Eigen::Vector4d() << end_m, radius_m).finished().cast<float>();
      to = std::copy_n(vertex.data(), 4, to);
    };
    for (const Capsule& part : body_parts(pose.walked_m)) {
      add_end(part.from_m, part.radius_m);
      add_end(part.to_m, part.radius_m);
    }
    rtcUpdateGeometryBuffer(body.segments, RTC_BUFFER_TYPE_VERTEX, 0);
    rtcCommitGeometry(body.segments);
    rtcCommitScene(body.scene);
    const auto c = static_cast<float>(std::cos(pose.heading_rad));
    const auto s = static_cast<float>(std::sin(pose.heading_rad));
    const Eigen::Vector3f feet = pose.feet_map_m.cast<float>();
    const std::array<float, 12> columns{c, s, 0, -s, c, 0, 0, 0, 1, feet.x(), feet.y(), feet.z()};
    rtcSetGeometryTransform(body.instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns.data());
    rtcCommitGeometry(body.instance);
  }

  std::string error;  ///< of the device, which needs it from the start
  RTCDevice device;
  RTCScene all;
  std::vector<Body> bodies;

 private:
  Body new_body() {
    constexpr std::size_t kParts = std::tuple_size_v<decltype(body_parts(0.0))>;
    Body body{rtcNewScene(device), rtcNewGeometry(device, RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE),
              rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE), nullptr};
    rtcSetSceneFlags(body.scene, RTC_SCENE_FLAG_DYNAMIC | RTC_SCENE_FLAG_ROBUST);
    body.vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(body.segments, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
                                4 * sizeof(float), 2 * kParts));
    auto* first_vertices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        body.segments, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, sizeof(std::uint32_t), kParts));
    if (body.vertices == nullptr || first_vertices == nullptr) return body;
    for (std::uint32_t part = 0; part < kParts; ++part) first_vertices[part] = 2 * part;
    rtcAttachGeometry(body.scene, body.segments);
    rtcSetGeometryInstancedScene(body.instance, body.scene);
    place(body, {});
    rtcAttachGeometry(all, body.instance);
    return body;
  }

  void release() {
    for (const Body& body : bodies) {
      rtcReleaseGeometry(body.segments);
      rtcReleaseGeometry(body.instance);
      rtcReleaseScene(body.scene);
    }
    rtcReleaseScene(all);
    rtcReleaseDevice(device);
  }
};

PeopleScene::PeopleScene(std::size_t count) : embree_(std::make_unique<Embree>(count)) {
  place(std::vector<BodyPose>(count));
}

PeopleScene::PeopleScene(PeopleScene&&) noexcept = default;
PeopleScene::~PeopleScene() = default;

void PeopleScene::place(std::span<const BodyPose> bodies) {
  if (bodies.size() != embree_->bodies.size()) {
    throw UsageError("there are not as many poses as people");
  }
  feet_map_m_.clear();
  for (const BodyPose& body : bodies) feet_map_m_.push_back(body.feet_map_m);
  for (std::size_t i = 0; i < bodies.size(); ++i) embree_->place(embree_->bodies[i], bodies[i]);
  rtcCommitScene(embree_->all);
}

void PeopleScene::shorten(const Eigen::Vector3d& origin_map_m,
                          std::span<const Eigen::Vector3f> directions_map, float range_max_m,
                          std::span<float> distances_m) const {
  const auto is_in_reach = [&](const Eigen::Vector3d& feet_map_m) {
    return (feet_map_m - origin_map_m).norm() < range_max_m + kBodyHeight_m;
  };
  if (std::ranges::none_of(feet_map_m_, is_in_reach)) return;
  shorten_to_hits(embree_->all, origin_map_m, directions_map, range_max_m, distances_m);
}

}  // namespace nbvopt
