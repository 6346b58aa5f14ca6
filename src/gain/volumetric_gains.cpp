// Volumetric information: S. Isler, R. Sabzevari, J. Delmerico, D. Scaramuzza, "An information gain
// formulation for active volumetric 3D reconstruction", ICRA 2016; J. Delmerico et al., "A
// comparison of volumetric information gain metrics for active 3D object reconstruction", 2018.
#include "gain/volumetric_gains.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <unordered_set>

#include "nbvopt/core/error.hpp"
#include "sensor/sensor_names.hpp"

namespace nbvopt::detail {
namespace {

double p_occ(VoxelState state) {
  switch (state) {
    case VoxelState::free:
      return kFreeProbability;
    case VoxelState::occupied:
      return kOccupiedProbability;
    case VoxelState::unknown:
      break;
  }
  return kUnknownProbability;
}

double entropy(double p) { return -p * std::log(p) - (1.0 - p) * std::log(1.0 - p); }

/// H of a voxel, in nats.
double entropy(VoxelState state) {
  static const double kFree = entropy(kFreeProbability);
  static const double kOccupied = entropy(kOccupiedProbability);
  static const double kUnknown = entropy(kUnknownProbability);
  if (state == VoxelState::unknown) return kUnknown;
  return state == VoxelState::free ? kFree : kOccupied;
}

/// Calls visit(voxel, P_vis) along a ray.
template <class Visit>
void with_visibility(std::span<const RayVoxel> ray, Visibility visibility, const Visit& visit) {
  double p_vis = 1.0;
  for (const RayVoxel& voxel : ray) {
    visit(voxel, p_vis);
    const double p = p_occ(voxel.state);
    p_vis *= visibility == Visibility::paper ? 1.0 - p : p;
  }
}

/// Where the unknown voxels right before a ray's last voxel begin; the last itself if none is.
std::size_t begin_of_hidden_run(std::span<const RayVoxel> ray) {
  std::size_t begin = ray.size() - 1;
  while (begin > 0 && ray[begin - 1].state == VoxelState::unknown) --begin;
  return begin;
}

/// Whether an unknown voxel lies right before the occupied one that ends the ray: its rear side is
/// looked at.
bool ends_at_rear_side(std::span<const RayVoxel> ray) {
  return ends_occupied(ray) && begin_of_hidden_run(ray) + 1 < ray.size();
}

// The gains that are sums over voxels: each calls add(voxel, part) for every part.

struct OcclusionAware {
  template <class Add>
  static void add_parts(const SeenView& view, const Add& add) {
    for (std::size_t i = 0; i < view.rays.size(); ++i) {
      with_visibility(view.rays.ray(i), view.sensor.visibility,
                      [&](const RayVoxel& v, double p_vis) { add(v, p_vis * entropy(v.state)); });
    }
  }
};

struct UnobservedVoxel {
  template <class Add>
  static void add_parts(const SeenView& view, const Add& add) {
    OcclusionAware::add_parts(view, [&](const RayVoxel& v, double part) {
      if (v.state == VoxelState::unknown) add(v, part);
    });
  }
};

struct RearSideVoxel {
  template <class Add>
  static void add_parts(const SeenView& view, const Add& add) {
    for (std::size_t i = 0; i < view.rays.size(); ++i) {
      const std::span<const RayVoxel> ray = view.rays.ray(i);
      if (ends_at_rear_side(ray)) add(ray.back(), 1.0);
    }
  }
};

struct RearSideEntropy {
  template <class Add>
  static void add_parts(const SeenView& view, const Add& add) {
    for (std::size_t i = 0; i < view.rays.size(); ++i) {
      const std::span<const RayVoxel> ray = view.rays.ray(i);
      if (!ends_at_rear_side(ray)) continue;
      const RayVoxel* first = &ray[begin_of_hidden_run(ray)];
      with_visibility(ray, view.sensor.visibility, [&](const RayVoxel& v, double p_vis) {
        if (&v >= first) add(v, p_vis * entropy(v.state));
      });
    }
  }
};

double average_entropy(const SeenView& view) {
  double sum = 0.0;
  std::size_t voxels = 0;
  for (std::size_t i = 0; i < view.rays.size(); ++i) {
    const std::span<const RayVoxel> ray = view.rays.ray(i);
    if (!ends_occupied(ray)) continue;
    for (const RayVoxel& v : ray) sum += entropy(v.state);
    voxels += ray.size();
  }
  return voxels == 0 ? 0.0 : sum / static_cast<double>(voxels);
}

/// The nearer to a surface, the more likely there is more of it.
struct ProximityCount {
  template <class Add>
  static void add_parts(const SeenView& view, const Add& add) {
    const double d_max = 2.0 * view.distances.reach();
    for (std::size_t i = 0; i < view.rays.size(); ++i) {
      for (const RayVoxel& v : view.rays.ray(i)) {
        if (v.state != VoxelState::unknown) continue;
        const double d_occ = view.distances.voxels_to_surface(v.key);
        if (std::isfinite(d_occ)) add(v, d_max - d_occ);
      }
    }
  }
};

/// 1 where the share is as wished, 0 where it is 0 or 1, smooth in between.
double area_factor(double share, double wished) {
  const double x = share, a = wished;
  if (x <= a) return -2.0 * std::pow(x / a, 3) + 3.0 * std::pow(x / a, 2);
  return (-2.0 * x * x * x + 3.0 * (a + 1.0) * x * x - 6.0 * a * x + 3.0 * a - 1.0) /
         std::pow(a - 1.0, 3);
}

/// A view should see some of what is known, to fit, and much of the occlusion planes behind it.
double vasquez_gomez_area(const SeenView& view) {
  constexpr double kWishedOccupied = 0.2, kWishedOccplane = 0.8;
  double occupied = 0.0, occplane = 0.0;
  for (std::size_t i = 0; i < view.rays.size(); ++i) {
    const std::span<const RayVoxel> ray = view.rays.ray(i);
    const auto first =
        std::ranges::find_if(ray, [](const RayVoxel& v) { return v.state != VoxelState::free; });
    if (first == ray.end()) continue;
    if (first->state == VoxelState::occupied) {
      ++occupied;
    } else if (std::isfinite(view.distances.voxels_to_surface(first->key))) {
      ++occplane;
    }
  }
  const auto rays = static_cast<double>(view.rays.size());
  return area_factor(occupied / rays, kWishedOccupied) +
         area_factor(occplane / rays, kWishedOccplane);
}

/// The weight of looking at a voxel from this distance: how many of a depth camera's rays meet it,
/// times that of each, 1 / z^2.
double look_weight(double voxel_m, double z_m) {
  constexpr double kSolidAngleOfRay = 0.002454 * 0.002681;  // rad^2
  const double angle_rad = 2.0 * std::atan2(voxel_m, 2.0 * z_m);
  return angle_rad * angle_rad / kSolidAngleOfRay / (z_m * z_m);
}

/// Of each surface voxel in sight the share of its weight that the view would bring, and 1 for each
/// unknown voxel beside a surface: L. Schmid et al., "An efficient sampling-based method for online
/// informative path planning in unknown environments", RA-L 2020. Maps keep u and no weights: those
/// of past looks are taken as that of one from where Eq. 2 gives u.
struct VoxelWeight {
  template <class Add>
  static void add_parts(const SeenView& view, const Add& add) {
    std::unordered_set<std::uint64_t> seen;
    for (std::size_t i = 0; i < view.rays.size(); ++i) {
      for (const RayVoxel& v : view.rays.ray(i)) {
        const bool counts = v.state == VoxelState::occupied || v.is_beside_surface;
        if (counts && seen.insert(packed(v.key)).second) add(v, part_of(view, v));
      }
    }
  }

 private:
  static double part_of(const SeenView& view, const RayVoxel& v) {
    constexpr double kLeastGain = 0.01;
    const double voxel_m = view.grid.lattice().resolution_m();
    if (v.state != VoxelState::occupied) return v.is_beside_surface ? 1.0 : 0.0;
    const double u = view.grid.carries_uncertainty() ? double{view.grid.uncertainty(v.key)}
                                                     : view.sensor.occupied_uncertainty;
    if (u >= 1.0) return 1.0;
    const double w_old = look_weight(
        voxel_m, std::max(voxel_m, view.sensor.focal_distance_m + std::log((1.0 + u) / (1.0 - u))));
    const double z_m = (view.grid.lattice().centre_m(v.key) - view.camera_m).norm();
    const double w_new = look_weight(voxel_m, std::max(voxel_m, z_m));
    const double share = w_new / (w_new + w_old);
    return share < kLeastGain ? 0.0 : share;
  }
};

struct VolumetricGain {
  GainKind kind;
  double (*gain)(const SeenView& view);
  void (*add_parts)(const SeenView& view, const AddPart& add);  ///< null: it is no sum
};

template <class Sum>
constexpr VolumetricGain sum_of_voxels(GainKind kind) {
  return {kind,
          [](const SeenView& view) {
            double sum = 0.0;
            Sum::add_parts(view, [&](const RayVoxel&, double part) { sum += part; });
            return sum;
          },
          [](const SeenView& view, const AddPart& add) { Sum::add_parts(view, add); }};
}

/// Every gain of this kind; a new one gets a line here and a name in sensor_names.hpp.
constexpr VolumetricGain kGains[] = {
    sum_of_voxels<OcclusionAware>(GainKind::occlusion_aware),
    sum_of_voxels<UnobservedVoxel>(GainKind::unobserved_voxel),
    sum_of_voxels<RearSideVoxel>(GainKind::rear_side_voxel),
    sum_of_voxels<RearSideEntropy>(GainKind::rear_side_entropy),
    sum_of_voxels<ProximityCount>(GainKind::proximity_count),
    {GainKind::vasquez_gomez_area, vasquez_gomez_area, nullptr},
    {GainKind::average_entropy, average_entropy, nullptr},
    sum_of_voxels<VoxelWeight>(GainKind::voxel_weight),
};

const VolumetricGain& gain_of(GainKind kind) {
  for (const VolumetricGain& known : kGains) {
    if (known.kind == kind) return known;
  }
  throw UsageError("gain " + std::string(enum_name(kind)) + " is no sum over a ray's voxels");
}

}  // namespace

double volumetric_gain(GainKind kind, const SeenView& view) { return gain_of(kind).gain(view); }

bool add_parts(GainKind kind, const SeenView& view, const AddPart& add) {
  const VolumetricGain& gain = gain_of(kind);
  if (gain.add_parts == nullptr) return false;
  gain.add_parts(view, add);
  return true;
}

}  // namespace nbvopt::detail
