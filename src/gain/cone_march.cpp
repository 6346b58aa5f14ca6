#include "gain/cone_march.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "gain/cone_span.hpp"
#include "gain/cone_window.hpp"
#include "nbvopt/sensor/uncertainty_model.hpp"

namespace nbvopt::detail {
namespace {

/// Cones whose rays' values differ by less are not looked at any closer.
constexpr double kSettled = 2e-3;

/// Of u_d by distance.
constexpr double kStepsPerVoxel = 16.0;

int voxel_of(double place) { return static_cast<int>(std::floor(place)); }

}  // namespace

/// What a cone touches between two planes of the grid across its main axis.
struct ConeMarch::Layer {
  int k = 0;
  ConeSpan depth;                         ///< of any point of it
  ConeSpan depth_before;                  ///< of the plane by which rays come in
  int row_first = 0, row_last = 0;        ///< voxels along the row axis
  int column_first = 0, column_last = 0;  ///< along the column axis

  bool fits() const {
    return row_last - row_first < kWindow && column_last - column_first < kWindow;
  }
  std::uint64_t all() const {
    return window_columns(0, row_last - row_first) & window_rows(0, column_last - column_first);
  }
};

ConeMarch::ConeMarch(const ConeGrid& grid, const DepthCamera& camera, double resolution_m,
                     bool carries_uncertainty)
    : grid_(grid),
      resolution_m_(resolution_m),
      near_blocking_(camera.options().near_blocking),
      sees_through_unknown_(camera.options().gain.has(GainKind::expected)) {
  const CameraRays& rays = camera.rays();
  const auto [nearest, farthest] =
      std::minmax_element(rays.range_min_m.begin(), rays.range_min_m.end());
  near_min_ = *nearest / resolution_m - kConeRounding;
  near_max_ = *farthest / resolution_m + kConeRounding;
  const auto [shortest, longest] =
      std::minmax_element(rays.range_max_m.begin(), rays.range_max_m.end());
  far_min_ = *shortest / resolution_m - kConeRounding;
  far_ = *longest / resolution_m + kConeRounding;
  const UncertaintyModel model(camera.options());
  focal_ = model.focal_distance_m() / resolution_m;
  // Up to the end of the last layer that the longest ray is in.
  const double longest_part = std::max(focal_, 2.0 * far_ + kWindow);
  for (int k = 0; k <= static_cast<int>(longest_part * kStepsPerVoxel) + 2; ++k) {
    distance_part_.push_back(model.distance_weight() * UncertaintyModel::focal_uncertainty(
                                                           k / kStepsPerVoxel * resolution_m));
  }
  unknown_value_ = kUnknownUncertainty - model.normal_weight() * kUnseenNormalUncertainty;
  none_stored_ = carries_uncertainty ? kUnknownUncertainty
                                     : static_cast<float>(camera.options().occupied_uncertainty);
}

double ConeMarch::least_distance_part(double from, double to) const {
  const double nearest = std::max({from - focal_, focal_ - to, 0.0});
  return distance_part_[static_cast<std::size_t>(nearest * kStepsPerVoxel)];
}

double ConeMarch::largest_distance_part(double from, double to) const {
  const double farthest = std::max(std::abs(from - focal_), std::abs(to - focal_));
  return distance_part_[static_cast<std::size_t>(farthest * kStepsPerVoxel) + 1];
}

ConeMarch::Layer ConeMarch::layer_at(const Cone& cone, int k) const {
  Layer layer;
  layer.k = k;
  layer.depth = {std::max(0.0, k - cone.origin_max[0]), k + 1 - cone.origin_min[0]};
  layer.depth_before = {layer.depth.min, std::max(0.0, k - cone.origin_min[0])};
  const ConeSpan row = places_at(cone.origin_min[1], cone.origin_max[1], cone.row_slope_min,
                                 cone.row_slope_max, layer.depth);
  const ConeSpan column = places_at(cone.origin_min[2], cone.origin_max[2], cone.column_slope_min,
                                    cone.column_slope_max, layer.depth);
  layer.row_first = voxel_of(row.min);
  layer.row_last = voxel_of(row.max);
  layer.column_first = voxel_of(column.min);
  layer.column_last = voxel_of(column.max);
  return layer;
}

int ConeMarch::free_layers(const Cone& cone, const Layer& layer) const {
  std::array<int, 3> middle{};
  middle[cone.across] = cone.goes_down ? grid_.size(cone.across) - 1 - layer.k : layer.k;
  const int row = (layer.row_first + layer.row_last) / 2;
  const int column = (layer.column_first + layer.column_last) / 2;
  middle[ConeGrid::row_axis(cone.across)] = row;
  middle[ConeGrid::column_axis(cone.across)] = column;
  const std::uint8_t code = grid_.code(middle);
  if (!is_free_code(code)) return 0;
  // A cube may end in voxels beside the unknown, in which the expected gain sees surfaces.
  const int radius = leap_radius(code) - (sees_through_unknown_ ? 1 : 0);
  const auto reaches = [&](const Layer& at) {
    return std::max(
        {row - at.row_first, at.row_last - row, column - at.column_first, at.column_last - column});
  };
  if (reaches(layer) > radius) return 0;
  // What the cone touches moves by at most a voxel a layer, and a little where it is steep.
  for (int ahead = radius; ahead > 0;) {
    const int beyond = reaches(layer_at(cone, layer.k + ahead)) - radius;
    if (beyond <= 0) return ahead + 1;
    ahead -= beyond;
  }
  return 1;
}

void ConeMarch::take_hits(const Cone& cone, const Layer& layer, std::uint64_t hits,
                          std::uint64_t in_front, ConeSpan& values) const {
  for (; hits != 0; hits &= hits - 1) {
    const int bit = std::countr_zero(hits);
    const std::array<int, 3> place = place_of(cone, layer, bit);
    const int row = place[ConeGrid::row_axis(cone.across)];
    const int column = place[ConeGrid::column_axis(cone.across)];
    const bool is_occupied = grid_.is_occupied(place);
    const double u_old =
        is_occupied ? double{grid_.uncertainty_of_occupied(place, none_stored_)} : unknown_value_;
    if (u_old <= values.max && values.min < values.max - kSettled) continue;
    const auto take = [&](ConeSpan depth) {
      const double from = std::max(depth.min * cone.stretch_min, near_min_);
      double to = std::max(depth.max * cone.stretch_max, near_max_);
      if (from > far_) return;
      to = std::min(to, far_);
      values.max = std::max(values.max, u_old - least_distance_part(from, to));
      // Where it is too far, a ray may hit nothing.
      const double least =
          to > far_min_ ? ConeView::kNothing : u_old - largest_distance_part(from, to);
      values.min = std::min(values.min, least);
    };
    const bool is_near = layer.depth.min * cone.stretch_min <= near_max_;
    if (is_near || (sees_through_unknown_ && !is_occupied)) {
      // Rays may begin inside, or meet a surface that the map does not show, anywhere inside.
      const double leaves = std::min({layer.depth.max,
                                      farthest_exit(row, cone.origin_min[1], cone.origin_max[1],
                                                    cone.row_slope_min, cone.row_slope_max),
                                      farthest_exit(column, cone.origin_min[2], cone.origin_max[2],
                                                    cone.column_slope_min, cone.column_slope_max)});
      if (leaves * cone.stretch_max >= near_min_) {
        take({layer.depth.min, std::max(layer.depth.min, leaves)});
      }
      continue;
    }
    if ((in_front >> bit & 1) != 0) take(layer.depth_before);
    // By which sides rays come in from beside it.
    const auto take_side = [&](double plane, int axis, double slope_min, double slope_max) {
      take(depths_at_plane(plane, cone.origin_min[axis], cone.origin_max[axis], slope_min,
                           slope_max, layer.depth));
    };
    if (cone.row_slope_max > 0.0 && row > layer.row_first) {
      take_side(row, 1, cone.row_slope_min, cone.row_slope_max);
    }
    if (cone.row_slope_min < 0.0 && row < layer.row_last) {
      take_side(row + 1, 1, cone.row_slope_min, cone.row_slope_max);
    }
    if (cone.column_slope_max > 0.0 && column > layer.column_first) {
      take_side(column, 2, cone.column_slope_min, cone.column_slope_max);
    }
    if (cone.column_slope_min < 0.0 && column < layer.column_last) {
      take_side(column + 1, 2, cone.column_slope_min, cone.column_slope_max);
    }
  }
}

std::array<int, 3> ConeMarch::place_of(const Cone& cone, const Layer& layer, int bit) const {
  std::array<int, 3> place{};
  place[cone.across] = cone.goes_down ? grid_.size(cone.across) - 1 - layer.k : layer.k;
  place[ConeGrid::row_axis(cone.across)] = layer.row_first + bit % kWindow;
  place[ConeGrid::column_axis(cone.across)] = layer.column_first + bit / kWindow;
  return place;
}

std::uint64_t ConeMarch::occupied_of(const Cone& cone, const Layer& layer,
                                     std::uint64_t voxels) const {
  std::uint64_t occupied = 0;
  for (; voxels != 0; voxels &= voxels - 1) {
    if (grid_.is_occupied(place_of(cone, layer, std::countr_zero(voxels)))) {
      occupied |= voxels & -voxels;
    }
  }
  return occupied;
}

std::uint64_t ConeMarch::frontiers_of(const Cone& cone, const Layer& layer,
                                      std::uint64_t voxels) const {
  std::uint64_t frontiers = 0;
  for (; voxels != 0; voxels &= voxels - 1) {
    if ((grid_.code(place_of(cone, layer, std::countr_zero(voxels))) & kFrontierBit) != 0) {
      frontiers |= voxels & -voxels;
    }
  }
  return frontiers;
}

ConeView ConeMarch::operator()(const Cone& cone) const {
  ConeView view;
  constexpr double kInf = std::numeric_limits<double>::infinity();
  ConeSpan values{kInf, ConeView::kNothing};  // of the hits so far
  bool was_cut_short = false;
  bool stopped_all = false;
  const int first = voxel_of(cone.origin_min[0] - kConeRounding);
  int k = std::max(first, voxel_of(cone.origin_min[0] + cone.clear / cone.stretch_max));
  bool is_clear = true;  // nothing was hit, and no ray was stopped
  bool is_full = true;   // all that the cone touches is reached
  const int last_origin = voxel_of(cone.origin_max[0] + kConeRounding);
  std::uint64_t reached = 0;  // of the layer before, which it counts from `last`
  Layer last;
  for (;;) {
    const Layer layer = layer_at(cone, k);
    const double nearest = layer.depth.min * cone.stretch_min;
    if (nearest > far_) break;
    // Whatever comes behind, it cannot bring more.
    const double most_behind =
        std::max(double{kUnknownUncertainty}, unknown_value_) -
        least_distance_part(std::max(nearest, near_min_), std::max(far_, nearest));
    if (values.max >= most_behind || !layer.fits()) {
      values.max = std::max(values.max, most_behind);
      was_cut_short = true;
      break;
    }
    if (is_full) {
      const int free = free_layers(cone, layer);
      if (free > 0) {
        k += free;
        if (is_clear) view.clear = (k - cone.origin_max[0]) * cone.stretch_min;
        continue;
      }
    }
    const std::uint64_t all = layer.all();
    const std::uint64_t free =
        all & grid_.free_window(cone.across, cone.goes_down ? grid_.size(cone.across) - 1 - k : k,
                                layer.row_first, layer.column_first,
                                layer.column_last - layer.column_first + 1);
    const bool is_near = nearest <= near_max_;
    // What rays pass through beyond the near field, and what they pass through here.
    const std::uint64_t open =
        sees_through_unknown_ ? all & ~occupied_of(cone, layer, all & ~free) : free;
    const std::uint64_t passable = is_near && near_blocking_
                                       ? all & ~occupied_of(cone, layer, all & ~free)
                                   : is_near ? all
                                             : open;

    // What rays come in to from the layer before, and then beside that.
    std::uint64_t in_front = all;
    if (k > last_origin) {  // no ray begins here
      const ConeSpan row = places_at(cone.origin_min[1], cone.origin_max[1], cone.row_slope_min,
                                     cone.row_slope_max, layer.depth_before);
      const ConeSpan column =
          places_at(cone.origin_min[2], cone.origin_max[2], cone.column_slope_min,
                    cone.column_slope_max, layer.depth_before);
      in_front &=
          window_columns(voxel_of(row.min) - layer.row_first, voxel_of(row.max) - layer.row_first);
      in_front &= window_rows(voxel_of(column.min) - layer.column_first,
                              voxel_of(column.max) - layer.column_first);
      if (!is_full) {
        in_front &= moved(reached, layer.row_first - last.row_first,
                          layer.column_first - last.column_first);
      }
    }
    // Rays cross a plane away from where they began.
    const auto from = [](double origin, int first_voxel) {
      return static_cast<int>(std::ceil(origin - kConeRounding)) - first_voxel;
    };
    const auto until = [](double origin, int first_voxel) {
      return voxel_of(origin + kConeRounding) - 1 - first_voxel;
    };
    const std::uint64_t row_up =
        cone.row_slope_max > 0.0
            ? window_columns(from(cone.origin_min[1], layer.row_first), kWindow)
            : 0;
    const std::uint64_t row_down =
        cone.row_slope_min < 0.0 ? window_columns(0, until(cone.origin_max[1], layer.row_first))
                                 : 0;
    const std::uint64_t column_up =
        cone.column_slope_max > 0.0
            ? window_rows(from(cone.origin_min[2], layer.column_first), kWindow)
            : 0;
    const std::uint64_t column_down =
        cone.column_slope_min < 0.0 ? window_rows(0, until(cone.origin_max[2], layer.column_first))
                                    : 0;
    std::uint64_t touched = in_front;
    for (;;) {
      const std::uint64_t through = touched & passable;
      const std::uint64_t grown =
          touched |
          (all & ((next_column(through) & row_up) | (previous_column(through) & row_down) |
                  ((through << 8) & column_up) | ((through >> 8) & column_down)));
      if (grown == touched) break;
      touched = grown;
    }

    std::uint64_t hits = touched & ~free;
    if (sees_through_unknown_) hits |= frontiers_of(cone, layer, touched & free);
    if (hits != 0 && is_near) was_cut_short = true;  // who passes is not told apart
    if (hits != 0 && layer.depth.max * cone.stretch_max >= near_min_) {
      is_clear = false;
      take_hits(cone, layer, hits, in_front, values);
    }
    // Who leaves the layer by its far end beyond the near field was hit by what is not free.
    const bool ends_near = (k + 1 - cone.origin_max[0]) * cone.stretch_min <= near_max_;
    reached = touched & (ends_near ? passable : open);
    if (reached == 0) {
      stopped_all = true;
      break;
    }
    is_full = reached == all;
    is_clear = is_clear && is_full;
    last = layer;
    ++k;
    if (is_clear) view.clear = (k - cone.origin_max[0]) * cone.stretch_min;
  }
  view.value = values.max;
  if (values.max == ConeView::kNothing) {
    view.clear = ConeView::kEndless;
    view.is_settled = true;
  } else {
    view.is_settled = stopped_all && !was_cut_short && values.max - values.min < kSettled;
  }
  view.clear = std::max(view.clear, cone.clear);
  return view;
}

}  // namespace nbvopt::detail
