// Values on the cells of a plane's lattice.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace nbvopt {

/// A cell of the lattice, named by whole numbers: cell (i, j) spans [i, i + 1) x [j, j + 1), times
/// the cell's edge, in the map. Arrays that grow keep their cells' names.
using Cell = Eigen::Vector2i;

/// A box of cells that grows as needed; every cell outside has the same value.
template <class T>
class CellArray {
 public:
  /// It grows by so many cells more than it must, so that one that grows often seldom copies.
  explicit CellArray(T outside, int margin = 64) : outside_(std::move(outside)), margin_(margin) {}

  /// The value of any cell.
  T at(const Cell& cell) const { return contains(cell) ? values_[index(cell)] : outside_; }

  /// The same, null outside of what was reserved.
  const T* find(const Cell& cell) const { return contains(cell) ? &values_[index(cell)] : nullptr; }

  /// A cell that was reserved.
  T& operator[](const Cell& cell) { return values_[index(cell)]; }

  /// Calls visit(value) for every cell that was reserved.
  template <class Visit>
  void for_each(const Visit& visit) {
    for (T& value : values_) visit(value);
  }

  /// Makes all cells of the box writable, and some around them.
  void reserve(const Eigen::AlignedBox2i& box) {
    if (!box.isEmpty() && contains(box.min()) && contains(box.max())) return;
    CellArray grown(outside_, margin_);
    Eigen::AlignedBox2i all = box;
    if (size_.x() > 0) all.extend(min_).extend(Cell(min_ + size_ - Cell::Ones()));
    grown.min_ = all.min() - Cell::Constant(margin_);
    grown.size_ = all.sizes() + Cell::Constant(2 * margin_ + 1);
    grown.values_.assign(
        static_cast<std::size_t>(grown.size_.x()) * static_cast<std::size_t>(grown.size_.y()),
        outside_);
    for (int row = 0; row < size_.y(); ++row) {
      const auto line = values_.begin() + static_cast<std::ptrdiff_t>(row) * size_.x();
      std::copy_n(line, size_.x(), &grown[min_ + Cell(0, row)]);
    }
    *this = std::move(grown);
  }

 private:
  bool contains(const Cell& cell) const {
    const Cell offset = cell - min_;
    return static_cast<unsigned>(offset.x()) < static_cast<unsigned>(size_.x()) &&
           static_cast<unsigned>(offset.y()) < static_cast<unsigned>(size_.y());
  }
  std::size_t index(const Cell& cell) const {
    const Cell offset = cell - min_;
    return static_cast<std::size_t>(offset.y()) * static_cast<std::size_t>(size_.x()) +
           static_cast<std::size_t>(offset.x());
  }

  T outside_;
  int margin_;
  Cell min_ = Cell::Zero();
  Cell size_ = Cell::Zero();
  std::vector<T> values_;  // row by row
};

}  // namespace nbvopt
