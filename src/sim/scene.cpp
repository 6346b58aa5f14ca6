#include "nbvopt/sim/scene.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <tuple>

#include "nbvopt/core/error.hpp"
#include "sim/ray_packets.hpp"
#include "sim/triangle_distance.hpp"

namespace nbvopt {
namespace {

void check(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) throw InputError("the scene holds no triangle: there is no geometry");
  for (const auto& triangle : mesh.triangles) {
    if (*std::max_element(triangle.begin(), triangle.end()) >= mesh.vertices_m.size()) {
      throw UsageError("a triangle of the scene has a corner that is not among its vertices");
    }
  }
  for (const Eigen::Vector3f& vertex : mesh.vertices_m) {
    if (!vertex.allFinite()) throw UsageError("a vertex of the scene is not finite");
  }
}

/// What a query for a surface near a point works on.
struct NearSurface {
  const float* vertices_m;
  const unsigned* corners;
  bool is_found = false;
};

/// Looks at a triangle near the query's point. Whether the query's radius has shrunk: to nothing,
/// since one triangle that is near enough ends the search.
bool look_at_triangle(RTCPointQueryFunctionArguments* arguments) {
  auto& near = *static_cast<NearSurface*>(arguments->userPtr);
  RTCPointQuery& query = *arguments->query;
  const auto corner = [&](unsigned which) {
    const float* vertex = &near.vertices_m[3 * near.corners[3 * arguments->primID + which]];
    return Eigen::Vector3f(vertex[0], vertex[1], vertex[2]);
  };
  const float squared_m2 =
      squared_triangle_distance({query.x, query.y, query.z}, corner(0), corner(1), corner(2));
  if (near.is_found || squared_m2 > query.radius * query.radius) return false;
  near.is_found = true;
  query.radius = 0.0F;
  return true;
}

}  // namespace

/// Owns Embree's handles.
struct Scene::Embree {
  explicit Embree(const TriangleMesh& mesh) : device(new_embree_device(error)) {
    scene = rtcNewScene(device);
    // Without it a ray through a shared edge may slip between two triangles.
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    attach(mesh);
    rtcCommitScene(scene);
    if (!error.empty()) {
      release();
      throw Error("Embree cannot build the scene: " + error);
    }
  }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;
  ~Embree() { release(); }

  std::string error;  ///< of the device, which needs it from the start
  RTCDevice device;
  RTCScene scene = nullptr;

 private:
  void attach(const TriangleMesh& mesh) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), mesh.vertices_m.size()));
    auto* indices = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), mesh.triangles.size()));
    if (vertices != nullptr && indices != nullptr) {
      for (const Eigen::Vector3f& vertex : mesh.vertices_m) {
        vertices = std::copy_n(vertex.data(), 3, vertices);
      }
      for (const auto& triangle : mesh.triangles) {
        indices = std::copy_n(triangle.data(), 3, indices);
      }
      rtcCommitGeometry(geometry);
      rtcAttachGeometry(scene, geometry);
    }
    rtcReleaseGeometry(geometry);
  }

  void release() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
};

Scene::Scene(const TriangleMesh& mesh) {
  check(mesh);
  embree_ = std::make_unique<Embree>(mesh);
}

Scene::~Scene() = default;

void Scene::first_hits(const Eigen::Vector3d& origin_map_m,
                       std::span<const Eigen::Vector3f> directions_map, float range_max_m,
                       std::span<float> distances_m) const {
  std::ranges::fill(distances_m, std::numeric_limits<float>::infinity());
  shorten_to_hits(embree_->scene, origin_map_m, directions_map, range_max_m, distances_m);
}

std::optional<SurfaceHit> Scene::first_surface(const Eigen::Vector3d& origin_map_m,
                                               const Eigen::Vector3f& direction_map,
                                               float range_max_m) const {
  const Eigen::Vector3f origin = origin_map_m.cast<float>();
  RTCRayHit ray{};
  std::tie(ray.ray.org_x, ray.ray.org_y, ray.ray.org_z) =
      std::tuple(origin.x(), origin.y(), origin.z());
  std::tie(ray.ray.dir_x, ray.ray.dir_y, ray.ray.dir_z) =
      std::tuple(direction_map.x(), direction_map.y(), direction_map.z());
  ray.ray.tfar = range_max_m;
  ray.ray.mask = ~0U;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(embree_->scene, &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const Eigen::Vector3f normal(ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z);
  return SurfaceHit{.distance_m = ray.ray.tfar, .is_outside = normal.dot(direction_map) < 0.0F};
}

bool Scene::has_surface_within(const Eigen::Vector3d& point_map_m, float distance_m) const {
  constexpr unsigned kGeometry = 0;  // the mesh
  RTCGeometry geometry = rtcGetGeometry(embree_->scene, kGeometry);
  NearSurface near{.vertices_m = static_cast<const float*>(
                       rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_VERTEX, 0)),
                   .corners = static_cast<const unsigned*>(
                       rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_INDEX, 0))};
  const Eigen::Vector3f point = point_map_m.cast<float>();
  RTCPointQuery query{
      .x = point.x(), .y = point.y(), .z = point.z(), .time = 0.0F, .radius = distance_m};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(embree_->scene, &query, &context, look_at_triangle, &near);
  return near.is_found;
}

}  // namespace nbvopt
