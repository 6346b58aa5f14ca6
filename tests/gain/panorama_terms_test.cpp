// The panorama's sum as its header states it, hit by hit, and its derivatives by automatic
// differentiation.
#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <vector>

#include "gain/panorama_directions.hpp"
#include "gain/panorama_world.hpp"
#include "nbvopt/gain/ray_caster.hpp"

namespace nbvopt::test {
namespace {

using Jet = ceres::Jet<double, 3>;  // by pan, tilt, height
template <typename T>
using Vector3 = Eigen::Matrix<T, 3, 1>;
template <typename T>
using Matrix3 = Eigen::Matrix<T, 3, 3>;

constexpr double kRounding = 0.005;

template <typename T>
T rounded_abs(const T& x) {
  using std::abs;
  return abs(x) < kRounding ? x * x / (2.0 * kRounding) + 0.5 * kRounding : abs(x);
}

template <typename T>
T rounded_relu(const T& x) {
  if (x <= -kRounding) return T(0.0);
  return x < kRounding ? (x + kRounding) * (x + kRounding) / (4.0 * kRounding) : x;
}

/// The C2 step from 0 at -1 to 1 at 1.
template <typename T>
T step(const T& t) {
  if (t <= -1.0) return T(0.0);
  if (t >= 1.0) return T(1.0);
  return 0.5 + t * (15.0 - t * t * (10.0 - 3.0 * t * t)) / 16.0;
}

/// What a ray of a layer met.
struct Hit {
  Eigen::Vector3d p_map_m;
  Eigen::Vector3d from_map_m;  ///< where it was cast
  Eigen::Vector3d normal;      ///< of the face by which the ray entered; the ray's own if inside
  double solid_angle;
  double u_old;
  bool is_inside;
  Eigen::Index patch;
};

/// Where a camera without lever arm is.
template <typename T>
struct CameraPose {
  Matrix3<T> R_map_sensor;
  Vector3<T> centre_map_m;

  CameraPose(const Transform& T_map_base, const Vector3<T>& q) {
    using std::cos;
    using std::sin;
    Matrix3<T> turn, tip;
    turn << cos(q[0]), -sin(q[0]), T(0.0), sin(q[0]), cos(q[0]), T(0.0), T(0.0), T(0.0), T(1.0);
    tip << cos(q[1]), T(0.0), -sin(q[1]), T(0.0), T(1.0), T(0.0), sin(q[1]), T(0.0), cos(q[1]);
    const Matrix3<T> R_map_base = T_map_base.linear().cast<T>();
    R_map_sensor = R_map_base * turn * tip * rotation_body_sensor().cast<T>();
    centre_map_m = R_map_base * Vector3<T>(T(0.0), T(0.0), q[2]) +
                   Vector3<T>(T_map_base.translation().cast<T>());
  }
};

/// One term of G(q), pixel-centre rays and Euclidean range.
template <typename T>
T term(const Hit& hit, const SensorOptions& sensor, double resolution_m,
       const CameraPose<T>& pose) {
  using std::abs;
  using std::atan;
  using std::exp;
  using std::pow;
  using std::tan;
  const Vector3<T> way = hit.p_map_m.cast<T>() - pose.centre_map_m;
  const Vector3<T> p_sensor = pose.R_map_sensor.transpose() * way;
  if (p_sensor.z() <= 0.1) return T(0.0);
  const T d = way.norm();
  const T X = p_sensor.x() / p_sensor.z();
  const T Y = p_sensor.y() / p_sensor.z();
  const T alpha_h = atan(X);
  const T alpha_v = atan(Y);
  const double F_h = sensor.half_fov_horizontal_rad;
  const double F_v = sensor.half_fov_vertical_rad;
  const double tau_h = 2.0 * F_h / sensor.horizontal_rays;
  const double tau_v = 2.0 * F_v / sensor.vertical_rays;

  const Eigen::Vector3d cast_way = hit.p_map_m - hit.from_map_m;
  const double d_0 = cast_way.norm();
  const double cos_theta_0 = cast_way.dot(hit.normal) / d_0;
  const T cos_theta = way.dot(hit.normal.cast<T>()) / d;
  const T w = hit.solid_angle * (cos_theta / cos_theta_0) * (d_0 / d) * (d_0 / d);

  const double rho = sensor.horizontal_rays * sensor.vertical_rays / (4.0 * tan(F_h) * tan(F_v));
  const T J = pow(1.0 + X * X + Y * Y, -1.5);
  const T S_h = step(T((F_h - abs(alpha_h)) / tau_h));
  const T S_v = step(T((F_v - abs(alpha_v)) / tau_v));
  const double half_gate_m = 0.5 * resolution_m;
  const T S_far = step(T((sensor.range_max_m + half_gate_m - d) / half_gate_m));

  const T seen_at = hit.is_inside ? T(sensor.range_min_m) : d;
  const T u_d = 1.0 - 2.0 / (1.0 + exp(rounded_abs(T(seen_at - sensor.focal_distance_m))));
  const T u_alpha = 0.5 * (rounded_abs(alpha_h) / F_h + rounded_abs(alpha_v) / F_v);
  const T u_new = 0.5 * (u_d + u_alpha);
  return w * rho / J * S_h * S_v * S_far * rounded_relu(T(hit.u_old - u_new));
}

/// What one layer's rays meet.
std::vector<Hit> cast_layer(const PanoramaWorld& world, double height_m) {
  const SensorOptions& sensor = world.sensor;
  const double tau_h = 2.0 * sensor.half_fov_horizontal_rad / sensor.horizontal_rays;
  const double tau_v = 2.0 * sensor.half_fov_vertical_rad / sensor.vertical_rays;
  const detail::PanoramaDirections directions(
      detail::directions_in_reach(world.box, sensor.half_fov_horizontal_rad + tau_h,
                                  sensor.half_fov_vertical_rad + tau_v),
      tau_h, tau_v, world.box, Eigen::Vector3d::Zero(), world.T_map_base.linear());
  const std::vector<double> range_min_m(directions.x.size(), sensor.range_min_m);
  const std::vector<double> range_max_m(directions.x.size(), sensor.range_max_m);
  RayBundle rays;
  rays.T_map_rays = world.T_map_base;
  rays.T_map_rays.translate(Eigen::Vector3d(0.0, 0.0, height_m));
  rays.x = directions.x;
  rays.y = directions.y;
  rays.z = directions.z;
  rays.range_min_m = range_min_m;
  rays.range_max_m = range_max_m;
  RayHits met;
  cast_rays(*world.grid, rays, sensor.occupied_uncertainty, met);

  std::vector<Hit> hits;
  for (std::size_t i = 0; i < met.size(); ++i) {
    if (met.kind[i] < HitKind::unknown) continue;
    const Eigen::Vector3d direction(met.direction_x[i], met.direction_y[i], met.direction_z[i]);
    Hit hit;
    hit.from_map_m = rays.T_map_rays.translation();
    hit.p_map_m = hit.from_map_m + met.distance_m[i] * direction;
    hit.is_inside = met.face[i] == Face::inside;
    hit.normal =
        hit.is_inside
            ? direction
            : Eigen::Vector3d(Eigen::Vector3d::Unit((static_cast<int>(met.face[i]) - 1) / 2));
    hit.solid_angle = directions.solid_angle[i];
    hit.u_old = met.uncertainty[i];
    hit.patch = static_cast<Eigen::Index>(i / detail::HitBlock::kSize);
    hits.push_back(hit);
  }
  return hits;
}

/// A world whose box spans two layers, one at either end of its heights.
class PanoramaTerms : public ::testing::Test {
 protected:
  PanoramaTerms() {
    world_.sensor.range_max_m = 1.5;
    world_.box = {{-0.4, -0.3, 0.35}, {0.5, 0.3, 0.4}};
    world_.options.double_precision = true;
  }

  /// Compares the panorama with the sum of the terms at random places.
  void expect_the_sum_of_terms() {
    const Panorama panorama = world_.panorama();
    const double low_m = world_.box.min[2];
    const double spacing_m = world_.box.max[2] - low_m;
    const std::vector<Hit> layers[] = {cast_layer(world_, low_m),
                                       cast_layer(world_, world_.box.max[2])};
    std::mt19937_64 random(31);
    for (int i = 0; i < 10; ++i) {
      const JointPosition q = world_.random_joints(random);
      const Vector3<Jet> q_jet(Jet(q.pan_rad, 0), Jet(q.tilt_rad, 1), Jet(q.height_m, 2));
      const CameraPose<Jet> pose(world_.T_map_base, q_jet);
      const Jet t = (q_jet[2] - low_m) / spacing_m;
      const Jet weight_above = t * t * (3.0 - 2.0 * t);
      std::vector<Jet> patches(static_cast<std::size_t>(panorama.patch_count()), Jet(0.0));
      for (const int above : {0, 1}) {
        const Jet weight = above ? weight_above : 1.0 - weight_above;
        for (const Hit& hit : layers[above]) {
          patches[static_cast<std::size_t>(hit.patch)] +=
              weight * term(hit, world_.sensor, world_.grid->lattice().resolution_m(), pose);
        }
      }
      expect_patches(panorama, q, patches);
    }
  }

  PanoramaWorld world_;

 private:
  static void expect_patches(const Panorama& panorama, const JointPosition& q,
                             const std::vector<Jet>& expected) {
    Jet sum(0.0);
    for (const Jet& patch : expected) sum += patch;
    ASSERT_GT(sum.a, 1.0) << "nothing is in view";
    Eigen::Vector3d gradient;
    EXPECT_NEAR(panorama.gain(q, gradient), sum.a, 1e-5 * sum.a);
    EXPECT_LT((gradient - sum.v).norm(), 1e-4 * sum.v.norm() + 1e-6 * sum.a);

    Eigen::VectorXd gains;
    Eigen::MatrixXd derivatives;
    panorama.patch_gains(q, gains, &derivatives);
    for (Eigen::Index i = 0; i < gains.size(); ++i) {
      const Jet& patch = expected[static_cast<std::size_t>(i)];
      EXPECT_NEAR(gains[i], patch.a, 1e-5 * sum.a);
      EXPECT_LT((derivatives.row(i).transpose() - patch.v).norm(),
                1e-4 * sum.v.norm() + 1e-6 * sum.a);
    }
  }
};

TEST_F(PanoramaTerms, OfOneVoxelAreThoseOfTheHeader) {
  UncertaintyMap map(0.1);
  set_box(map, cube(key_from_origin(-20, -20, -20), 40), kFree);
  map.set(map.lattice().key({1.05, 0.35, 0.35}), occupied(0.9F));
  map.finish_writing();
  world_.grid = VoxelGrid::whole(map);
  expect_the_sum_of_terms();
}

TEST_F(PanoramaTerms, OfSomeVoxelsAreThoseOfTheHeader) {
  UncertaintyMap map(0.1);
  set_box(map, cube(key_from_origin(-20, -20, -20), 40), kFree);
  map.set(map.lattice().key({0.85, 0.35, 0.15}), occupied(0.5F));  // seen from above
  map.set(map.lattice().key({1.05, 0.55, 0.35}), occupied(0.9F));
  map.set(map.lattice().key({1.25, 0.15, 0.65}), occupied(1.0F));
  map.set(map.lattice().key({1.45, 0.45, 0.35}), occupied(1.0F));  // across the far gate
  map.finish_writing();
  world_.grid = VoxelGrid::whole(map);
  expect_the_sum_of_terms();
}

TEST_F(PanoramaTerms, OfUnknownSpaceAreThoseOfTheHeader) {
  world_.grid = unknown_space(0.1);
  expect_the_sum_of_terms();
}

}  // namespace
}  // namespace nbvopt::test
