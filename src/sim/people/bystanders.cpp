#include "sim/people/bystanders.hpp"

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <variant>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/sim/floor.hpp"
#include "sim/air.hpp"
#include "sim/people/body.hpp"

namespace nbvopt {
namespace {

constexpr double kAirRange_m = 100.0;

[[noreturn]] void refuse_person(const Person& person, const Eigen::Vector3d& position_map_m,
                                const std::string& what) {
  throw InputError("actor '" + person.name + "' " + what + " at (" +
                   format_number(position_map_m.x()) + ", " + format_number(position_map_m.y()) +
                   "): move it in the world's file, or leave people out");
}

/// How much room there is around the axis of a body, as far as it is wide.
double room_m(const Scene& scene, const Eigen::Vector3d& feet_map_m) {
  constexpr int kDirections = 16;
  std::vector<Eigen::Vector3f> directions;
  for (int i = 0; i < kDirections; ++i) {
    const float angle_rad = 2.0F * std::numbers::pi_v<float> * static_cast<float>(i) / kDirections;
    directions.emplace_back(std::cos(angle_rad), std::sin(angle_rad), 0.0F);
  }
  std::vector<float> distances_m(directions.size());
  float least_m = kBodyRadius_m;
  for (const double share : {0.2, 0.4, 0.6, 0.8}) {
    scene.first_hits(feet_map_m + Eigen::Vector3d(0.0, 0.0, share * kBodyHeight_m), directions,
                     static_cast<float>(kBodyRadius_m), distances_m);
    for (const float distance_m : distances_m) least_m = std::min(least_m, distance_m);
  }
  return least_m;
}

/// How far below his position somebody's feet are, once he has been found in the free.
double feet_below_m(const Scene& scene, const Person& person, const WalkerPose& first) {
  const Eigen::Vector3d position_map_m = first.position_map_m;
  // A position may be one of hips or, in a hand-made world, of feet.
  constexpr double kAbove_m = 0.5;
  const std::optional<double> floor_m =
      floor_height_m(scene, position_map_m + Eigen::Vector3d(0.0, 0.0, kAbove_m));
  if (!floor_m) refuse_person(person, position_map_m, "has no floor below");
  const Eigen::Vector3d feet_map_m(position_map_m.x(), position_map_m.y(), *floor_m);
  const Eigen::Vector3d head_map_m = feet_map_m + Eigen::Vector3d(0.0, 0.0, 0.8 * kBodyHeight_m);
  if (room_m(scene, feet_map_m) < kBodyRadius_m ||
      air_above_m3(scene, head_map_m, kAirRange_m) < kLeastAir_m3) {
    refuse_person(person, position_map_m, "stands in or at a wall or a piece of furniture");
  }
  const bool has_target = std::holds_alternative<TargetWalk>(person.walk);
  return (has_target ? TargetWalker::kHeight_m : position_map_m.z()) - *floor_m;
}

}  // namespace

Bystanders::Bystanders(const Scene& scene, const People& people, std::uint64_t seed)
    : crowd_(people, seed), bodies_(people.persons.size()) {
  for (std::size_t i = 0; i < people.persons.size(); ++i) {
    feet_below_m_.push_back(feet_below_m(scene, people.persons[i], crowd_.poses()[i]));
  }
}

void Bystanders::move_to(double time_s, const RobotPosition& robot_map_m) {
  crowd_.walk_until(time_s, robot_map_m);
  std::vector<BodyPose> bodies;
  for (std::size_t i = 0; i < feet_below_m_.size(); ++i) {
    const WalkerPose& pose = crowd_.poses()[i];
    bodies.push_back({pose.position_map_m - Eigen::Vector3d(0.0, 0.0, feet_below_m_[i]),
                      pose.heading_rad, pose.walked_m});
  }
  bodies_.place(bodies);
}

std::optional<Bystanders> bystanders_of(const Scene& scene, const People& people,
                                        std::uint64_t seed) {
  if (people.persons.empty()) return std::nullopt;
  return std::optional<Bystanders>(std::in_place, scene, people, seed);
}

}  // namespace nbvopt
