#include "study/spec/start_sampling.hpp"

#include <numbers>
#include <random>

#include "core/uniform.hpp"

namespace nbvopt::study {
namespace {

constexpr int kMostTries = 100'000;

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : generator_(seed) {}
  double between(double low, double high) { return low + (high - low) * uniform(generator_); }

 private:
  std::mt19937_64 generator_;
};

}  // namespace

std::optional<std::vector<Start>> sample_starts(const UncertaintyMap& map, const Mast& mast,
                                                double base_z_m, std::size_t count,
                                                std::uint64_t seed) {
  const std::optional<KeyBox> known = map.known_box();
  if (!known) return std::nullopt;
  const Eigen::Vector3d low_m = map.lattice().centre_m(known->min);
  const Eigen::Vector3d high_m = map.lattice().centre_m(known->max);
  const MastOptions& limits = mast.options();
  const double pan_min_rad = limits.pan_continuous ? -std::numbers::pi : limits.pan_min_rad;
  const double pan_max_rad = limits.pan_continuous ? std::numbers::pi : limits.pan_max_rad;
  Draw draw(seed);
  std::vector<Start> starts;
  for (int tries = 0; starts.size() < count; ++tries) {
    if (tries == kMostTries) return std::nullopt;
    Start start;
    start.x_m = draw.between(low_m.x(), high_m.x());
    start.y_m = draw.between(low_m.y(), high_m.y());
    start.z_m = base_z_m;
    start.yaw_rad = draw.between(-std::numbers::pi, std::numbers::pi);
    start.joints.pan_rad = draw.between(pan_min_rad, pan_max_rad);
    start.joints.tilt_rad = draw.between(limits.tilt_min_rad, limits.tilt_max_rad);
    start.joints.height_m = draw.between(limits.height_min_m, limits.height_max_m);
    const PlanRequest request = request_of(start);
    const Transform camera = T_map_sensor(request, mast, request.joints);
    if (map.at(map.lattice().key(camera.translation())).state != VoxelState::free) continue;
    starts.push_back(start);
    tries = 0;
  }
  return starts;
}

PlanRequest request_of(const Start& start) {
  PlanRequest request;
  request.T_map_base = base_pose(start.x_m, start.y_m, start.z_m, start.yaw_rad);
  request.joints = start.joints;
  return request;
}

}  // namespace nbvopt::study
