// Where a bundle of rays from one point can pass.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>

#include "map/segment_walk.hpp"

namespace nbvopt {

/// A bound of what all segments from a point to the points of a box pierce, on SegmentWalk's
/// lattice, slab by slab of its longest axis (as in shaft culling, Haines and Wallace 1991). It is
/// wide enough for a walk's rounding.
class Shaft {
 public:
  Shaft(const Eigen::Vector3d& origin, const Eigen::AlignedBox3d& ends) : origin_(origin) {
    Eigen::AlignedBox3d all = ends;
    all.extend(origin);
    (ends.center() - origin).cwiseAbs().maxCoeff(&a_);
    slabs_ = {static_cast<int>(all.min()[a_] - kRounding),
              static_cast<int>(all.max()[a_] + kRounding)};
    least_a_ = all.min()[a_];
    most_a_ = all.max()[a_];
    b_ = across((a_ + 1) % 3, ends, all);
    c_ = across((a_ + 2) % 3, ends, all);
  }

  int axis() const { return a_; }
  SlabRange slabs() const { return slabs_; }

  /// The cells of a slab that segments may pierce, on the two axes after the longest one.
  struct Cells {
    int first_b, last_b, first_c, last_c;
  };
  Cells cells(int slab) const {
    const double from = std::max<double>(slab, least_a_) - origin_[a_];
    const double to = std::min<double>(slab + 1, most_a_) - origin_[a_];
    Cells cells{};
    b_.cells(from, to, cells.first_b, cells.last_b);
    c_.cells(from, to, cells.first_c, cells.last_c);
    return cells;
  }

 private:
  static constexpr double kRounding = 1e-6;  ///< a walk's is 65536 steps of 2^-40 at most

  /// One of the axes across.
  struct Across {
    double origin;
    double least_slope, most_slope;  ///< of segments, by the way along the longest axis
    double least, most;              ///< of segments
    bool is_cone;                    ///< else there are no slopes: an end is beside the origin

    /// Between two distances along the longest axis.
    void cells(double from, double to, int& first, int& last) const {
      double low = least;
      double high = most;
      if (is_cone) {
        low = std::max(low, origin + std::min(std::min(from * least_slope, from * most_slope),
                                              std::min(to * least_slope, to * most_slope)));
        high = std::min(high, origin + std::max(std::max(from * least_slope, from * most_slope),
                                                std::max(to * least_slope, to * most_slope)));
      }
      first = static_cast<int>(low - kRounding);
      last = static_cast<int>(high + kRounding);
    }
  };

  Across across(int axis, const Eigen::AlignedBox3d& ends, const Eigen::AlignedBox3d& all) const {
    const double near = ends.min()[a_] - origin_[a_];
    const double far = ends.max()[a_] - origin_[a_];
    const double low = ends.min()[axis] - origin_[axis];
    const double high = ends.max()[axis] - origin_[axis];
    Across across{origin_[axis], 0.0, 0.0, all.min()[axis], all.max()[axis], false};
    if (near > 0.0 || far < 0.0) {
      across.is_cone = true;
      const auto [least, most] = std::minmax({low / near, low / far, high / near, high / far});
      across.least_slope = least;
      across.most_slope = most;
    }
    return across;
  }

  Eigen::Vector3d origin_;
  int a_ = 0;
  SlabRange slabs_;
  double least_a_ = 0.0, most_a_ = 0.0;
  Across b_{}, c_{};
};

}  // namespace nbvopt
