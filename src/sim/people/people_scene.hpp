// People as rays meet them.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace nbvopt {

/// Somebody as he stands.
struct BodyPose {
  Eigen::Vector3d feet_map_m = Eigen::Vector3d::Zero();
  double heading_rad = 0.0;
  double walked_m = 0.0;
};

/// The bodies of people (Embree, an instance each), beside the static world's Scene, which is cast
/// as fast as if nobody were there. One thread places them; casting is safe while nobody does.
class PeopleScene {
 public:
  /// With so many people at the origin.
  explicit PeopleScene(std::size_t count);
  PeopleScene(PeopleScene&&) noexcept;
  ~PeopleScene();

  /// Moves everybody; as many as there are.
  void place(std::span<const BodyPose> bodies);

  /// Shortens the distances along rays from the origin, +inf among them, to the first body that is
  /// nearer, and than the range, too. Directions and threads as in Scene::first_hits().
  void shorten(const Eigen::Vector3d& origin_map_m, std::span<const Eigen::Vector3f> directions_map,
               float range_max_m, std::span<float> distances_m) const;

 private:
  struct Embree;
  std::unique_ptr<Embree> embree_;
  std::vector<Eigen::Vector3d> feet_map_m_;
};

}  // namespace nbvopt
