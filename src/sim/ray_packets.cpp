#include "sim/ray_packets.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

constexpr std::size_t kPacket = 16;

/// Embree reports what goes wrong through a callback only.
void keep_first_error(void* message, RTCError /*code*/, const char* text) {
  auto& first = *static_cast<std::string*>(message);
  if (first.empty()) first = text;
}

/// Casts up to kPacket rays at once.
void cast_packet(RTCScene scene, const Eigen::Vector3f& origin, const Eigen::Vector3f* directions,
                 std::size_t count, float range_max_m, float* distances_m) {
  alignas(64) std::array<int, kPacket> valid{};
  alignas(64) RTCRayHit16 packet;
  for (std::size_t i = 0; i < kPacket; ++i) {
    const std::size_t ray = std::min(i, count - 1);
    const Eigen::Vector3f& direction = directions[ray];
    valid[i] = i < count ? -1 : 0;
    packet.ray.org_x[i] = origin.x();
    packet.ray.org_y[i] = origin.y();
    packet.ray.org_z[i] = origin.z();
    packet.ray.tnear[i] = 0.0F;
    packet.ray.dir_x[i] = direction.x();
    packet.ray.dir_y[i] = direction.y();
    packet.ray.dir_z[i] = direction.z();
    packet.ray.time[i] = 0.0F;
    packet.ray.tfar[i] = std::min(range_max_m, distances_m[ray]);
    packet.ray.mask[i] = ~0U;
    packet.ray.flags[i] = 0;
    packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid.data(), scene, &context, &packet);
  for (std::size_t i = 0; i < count; ++i) {
    if (packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID) distances_m[i] = packet.ray.tfar[i];
  }
}

}  // namespace

RTCDevice new_embree_device(std::string& first_error) {
  RTCDevice device = rtcNewDevice(nullptr);
  if (device == nullptr) throw Error("Embree cannot start: it supports x86-64 processors");
  rtcSetDeviceErrorFunction(device, keep_first_error, &first_error);
  return device;
}

void shorten_to_hits(RTCScene scene, const Eigen::Vector3d& origin_map_m,
                     std::span<const Eigen::Vector3f> directions_map, float range_max_m,
                     std::span<float> distances_m) {
  if (directions_map.size() != distances_m.size()) {
    throw UsageError("directions and distances differ in number");
  }
  // A task should be worth its start: some tens of microseconds.
  constexpr std::size_t kPacketsATask = 64;
  const Eigen::Vector3f origin = origin_map_m.cast<float>();
  const std::size_t packets = (directions_map.size() + kPacket - 1) / kPacket;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, packets, kPacketsATask),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t packet = range.begin(); packet != range.end(); ++packet) {
                        const std::size_t first = packet * kPacket;
                        cast_packet(scene, origin, &directions_map[first],
                                    std::min(kPacket, directions_map.size() - first), range_max_m,
                                    &distances_m[first]);
                      }
                    });
}

}  // namespace nbvopt
