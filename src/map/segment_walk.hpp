// Which lattice cells a straight segment pierces.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace nbvopt {

/// Slabs of cells between two integers of an axis, by their lower ones; both included.
struct SlabRange {
  int first = 0;
  int last = 0;
};
inline constexpr SlabRange kAllSlabs{0, 65535};

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

  /// The longest axis.
  int axis() const { return a_; }

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

  /// Calls visit(number) for every cell that the segment pierces, some of them twice. A cell's
  /// number is the sum of number_part[axis][coordinate] over the axes; parts of different
  /// coordinates differ. Rounding may ask for coordinates on b and c one beyond the ends'.
  template <class Part, class Visit>
  void for_each_cell(const std::array<Part, 3>& number_part, const Visit& visit) const {
    for_each_cell_of(kAllSlabs, number_part, visit);
  }

  /// The same for the cells in some slabs alone.
  template <class Part, class Visit>
  void for_each_cell_of(SlabRange slabs, const std::array<Part, 3>& number_part,
                        const Visit& visit) const {
    const Part part_a = number_part[a_];
    const Part part_b = number_part[b_];
    const Part part_c = number_part[c_];
    const int start = static_cast<int>(start_[a_]);
    const int end = static_cast<int>(end_[a_]);
    const int first = std::max(start, slabs.first);
    const int last = std::min(end, slabs.last);
    if (first > last) return;
    const std::int64_t end_b = fixed(end_[b_]);
    const std::int64_t end_c = fixed(end_[c_]);
    const std::int64_t step_b = fixed(slope_b_);
    const std::int64_t step_c = fixed(slope_c_);
    // Where the line enters the slab, and by which cell the segment does.
    std::int64_t b = fixed(start_[b_] - (start_[a_] - start) * slope_b_) + (first - start) * step_b;
    std::int64_t c = fixed(start_[c_] - (start_[a_] - start) * slope_c_) + (first - start) * step_c;
    auto number_b = part_b[cell(first == start ? fixed(start_[b_]) : b)];
    auto number_c = part_c[cell(first == start ? fixed(start_[c_]) : c)];
    for (int slab = first; slab <= last; ++slab) {
      const std::int64_t next_b = slab == end ? end_b : b + step_b;
      const std::int64_t next_c = slab == end ? end_c : c + step_c;
      const auto number_a = part_a[slab];
      const auto next_number_b = part_b[cell(next_b)];
      const auto next_number_c = part_c[cell(next_c)];
      visit(number_a + number_b + number_c);
      visit(number_a + next_number_b + next_number_c);
      // One test of both, since either alone is as hard to predict as a coin.
      if ((next_number_b != number_b) & (next_number_c != number_c)) [[unlikely]] {
        const bool b_first = crosses_b_first(b, c, next_b, next_c);
        visit(number_a + (b_first ? next_number_b + number_c : number_b + next_number_c));
      }
      b = next_b;
      c = next_c;
      number_b = next_number_b;
      number_c = next_number_c;
    }
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

  /// Which face a slab's part that leaves its first cell on both axes crosses first:
  /// (face_b - b0) / slope_b < (face_c - c0) / slope_c.
  bool crosses_b_first(std::int64_t b0, std::int64_t c0, std::int64_t b1, std::int64_t c1) const {
    const double to_face_b = std::abs(static_cast<double>(face(b0, b1) - b0));
    const double to_face_c = std::abs(static_cast<double>(face(c0, c1) - c0));
    return to_face_b * std::abs(slope_c_) < to_face_c * std::abs(slope_b_);
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
