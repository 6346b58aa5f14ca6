// Which lattice cells a straight segment pierces.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace nbvopt {

/// A segment on a lattice, where cell k spans [k, k + 1), seen along its longest axis `a`: in each
/// slab of cells between two integers of that axis it pierces one, two or three cells, so that
/// one slab is a few instructions without a decision that is hard to predict. Coordinates lie in
/// [0, 65536). The segment has no direction: its cells are the same from either end.
class SegmentWalk {
 public:
  SegmentWalk(const Eigen::Vector3d& from, const Eigen::Vector3d& to) : start_(from), end_(to) {
    (to - from).cwiseAbs().maxCoeff(&a_);
    b_ = (a_ + 1) % 3;
    c_ = (a_ + 2) % 3;
    if (start_[a_] > end_[a_]) std::swap(start_, end_);
    const double length = end_[a_] - start_[a_];
    const double inverse_length = length > 0.0 ? 1.0 / length : 0.0;
    slope_b_ = (end_[b_] - start_[b_]) * inverse_length;
    slope_c_ = (end_[c_] - start_[c_]) * inverse_length;
  }

  /// The axes, as indices of a vector: the slabs' axis, then the two others.
  int a() const { return a_; }
  int b() const { return b_; }
  int c() const { return c_; }

  /// Cuts the segment to the part inside the box [least, most). Returns false when none is left.
  bool clip(const Eigen::Vector3d& least, const Eigen::Vector3d& most) {
    const auto inside = [&](const Eigen::Vector3d& p) {
      return (p.array() >= least.array()).all() && (p.array() < most.array()).all();
    };
    if (inside(start_) && inside(end_)) return true;
    double low = std::max(start_[a_], least[a_]);
    double high = std::min(end_[a_], most[a_]);
    narrow(b_, slope_b_, least[b_], most[b_], low, high);
    narrow(c_, slope_c_, least[c_], most[c_], low, high);
    if (low > high) return false;
    const Eigen::Vector3d cut_start = at(low).cwiseMax(least).cwiseMin(below(most));
    end_ = at(high).cwiseMax(least).cwiseMin(below(most));
    start_ = cut_start;
    return start_[a_] <= end_[a_];
  }

  /// Calls visit(slab, b0, c0, b1, c1) with the cells by which the segment enters and leaves each
  /// slab, which may be one; where it passes a third between them, visit is called once more with
  /// that one as both. Rounding may put b and c beyond the ends' cells by one.
  template <class Visit>
  void for_each_slab(const Visit& visit) const {
    int slab = static_cast<int>(start_[a_]);
    const int last = static_cast<int>(end_[a_]);
    std::int64_t b = fixed(start_[b_]);
    std::int64_t c = fixed(start_[c_]);
    if (slab < last) {
      const double first_part = slab + 1 - start_[a_];
      const std::int64_t b1 = fixed(start_[b_] + first_part * slope_b_);
      const std::int64_t c1 = fixed(start_[c_] + first_part * slope_c_);
      pass(slab, b, c, b1, c1, visit);
      b = b1;
      c = c1;
      const std::int64_t step_b = fixed(slope_b_);
      const std::int64_t step_c = fixed(slope_c_);
      for (++slab; slab < last; ++slab) {
        pass(slab, b, c, b + step_b, c + step_c, visit);
        b += step_b;
        c += step_c;
      }
    }
    pass(last, b, c, fixed(end_[b_]), fixed(end_[c_]), visit);
  }

 private:
  /// Positions on b and c are kept in fixed point, as fine as doubles are at the lattice's middle.
  static constexpr int kFractionBits = 40;
  static std::int64_t fixed(double coordinate) {
    return static_cast<std::int64_t>(coordinate * (std::int64_t{1} << kFractionBits));
  }
  static int cell(std::int64_t position) { return static_cast<int>(position >> kFractionBits); }

  static Eigen::Vector3d below(const Eigen::Vector3d& p) {
    return p.unaryExpr([](double x) { return std::nextafter(x, 0.0); });
  }

  Eigen::Vector3d at(double position_a) const {
    Eigen::Vector3d p;
    p[a_] = position_a;
    p[b_] = start_[b_] + (position_a - start_[a_]) * slope_b_;
    p[c_] = start_[c_] + (position_a - start_[a_]) * slope_c_;
    return p;
  }

  /// Narrows [low, high] to where the segment is inside [least, most] on one axis.
  void narrow(int axis, double slope, double least, double most, double& low, double& high) const {
    if (slope == 0.0) {
      if (start_[axis] < least || start_[axis] >= most) high = -1.0;
      return;
    }
    const double at_least = start_[a_] + (least - start_[axis]) / slope;
    const double at_most = start_[a_] + (most - start_[axis]) / slope;
    low = std::max(low, std::min(at_least, at_most));
    high = std::min(high, std::max(at_least, at_most));
  }

  template <class Visit>
  void pass(int slab, std::int64_t b0, std::int64_t c0, std::int64_t b1, std::int64_t c1,
            const Visit& visit) const {
    visit(slab, cell(b0), cell(c0), cell(b1), cell(c1));
    if (cell(b0 ^ b1) == 0 || cell(c0 ^ c1) == 0) [[likely]]
      return;
    // The face that is crossed first: (face_b - b0) / slope_b < (face_c - c0) / slope_c.
    const double to_face_b = std::abs(static_cast<double>(face(b0, b1) - b0));
    const double to_face_c = std::abs(static_cast<double>(face(c0, c1) - c0));
    const bool b_first = to_face_b * std::abs(slope_c_) < to_face_c * std::abs(slope_b_);
    const int b_mid = cell(b_first ? b1 : b0);
    const int c_mid = cell(b_first ? c0 : c1);
    visit(slab, b_mid, c_mid, b_mid, c_mid);
  }

  /// The face between the cells of two positions in neighbouring cells.
  static std::int64_t face(std::int64_t position0, std::int64_t position1) {
    return std::max(position0, position1) >> kFractionBits << kFractionBits;
  }

  Eigen::Vector3d start_, end_;
  int a_ = 0, b_ = 1, c_ = 2;
  double slope_b_ = 0.0, slope_c_ = 0.0;
};

}  // namespace nbvopt
