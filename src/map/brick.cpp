#include "map/brick.hpp"

#include <functional>
#include <numeric>

namespace nbvopt::detail {

void BrickStates::finish(const float* uncertainty_of_voxels) {
  const auto any = [](const auto& rows) {
    return std::accumulate(rows.begin(), rows.end(), 0U, std::bit_or<std::uint32_t>()) != 0;
  };
  has_occupied = any(occupied);
  has_free = any(free);
  uncertainty.clear();
  if (uncertainty_of_voxels == nullptr) return;

  bool any_below_one = false;
  for (int row = 0; row < kBrickRows; ++row) {
    occupied_before_row[row] = static_cast<std::uint16_t>(uncertainty.size());
    for (std::uint32_t left = occupied[row]; left != 0; left &= left - 1) {
      const float u = uncertainty_of_voxels[row * kBrickSize + std::countr_zero(left)];
      any_below_one |= u != kUnknownUncertainty;
      uncertainty.push_back(u);
    }
  }
  if (!any_below_one) uncertainty.clear();
  uncertainty.shrink_to_fit();
}

const std::shared_ptr<const Brick>& unknown_brick() {
  static const std::shared_ptr<const Brick> brick = [] {
    auto b = std::make_shared<Brick>();
    b->states = std::make_shared<BrickStates>();
    b->code.fill(kUnknownCode);
    return b;
  }();
  return brick;
}

}  // namespace nbvopt::detail
