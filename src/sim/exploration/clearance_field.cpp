#include "sim/exploration/clearance_field.hpp"

#include <algorithm>
#include <cmath>

namespace nbvopt {

ClearanceField::ClearanceField(double cell_m, double reach_m)
    : reach_cells_(static_cast<int>(std::ceil(reach_m / cell_m))),
      clearance_m_(static_cast<float>(reach_m)) {
  for (int y = -reach_cells_; y <= reach_cells_; ++y) {
    for (int x = -reach_cells_; x <= reach_cells_; ++x) {
      const double distance_m = std::hypot(x, y) * cell_m;
      if (distance_m < reach_m) disc_.push_back({Cell(x, y), static_cast<float>(distance_m)});
    }
  }
}

void ClearanceField::add_occupied(std::span<const Cell> cells) {
  if (cells.empty()) return;
  Eigen::AlignedBox2i box;
  for (const Cell& cell : cells) box.extend(cell);
  const Cell reach = Cell::Constant(reach_cells_);
  clearance_m_.reserve({box.min() - reach, box.max() + reach});
  for (const Cell& cell : cells) {
    for (const Offset& near : disc_) {
      float& clearance_m = clearance_m_[cell + near.offset];
      clearance_m = std::min(clearance_m, near.distance_m);
    }
  }
}

}  // namespace nbvopt
