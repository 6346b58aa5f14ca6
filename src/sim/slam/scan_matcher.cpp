#include "sim/slam/scan_matcher.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace nbvopt {
namespace {

constexpr double kScoreSigma_m = 0.05;
constexpr double kLikelihoodSigma = 0.075;
constexpr double kNoHitLogLikelihood = -0.5 / kLikelihoodSigma;
constexpr double kStep_m = 0.05;
constexpr double kStep_rad = 0.05;
constexpr int kRefinements = 5;

/// How far the climb may lead from its guess, at most; beyond, nothing fits.
constexpr double kClimbMax_m = 1.0;

constexpr float kFarOff = 1e4F;  ///< cells; its square is HitField::kNone

/// A scan at poses on a field of hits.
class ScanScore {
 public:
  ScanScore(const HitField& field, double cell_m, std::span<const Eigen::Vector2f> hits_base_m)
      : field_(field), cell_m_(cell_m), hits_base_m_(hits_base_m) {}

  double operator()(const PlanarPose& T_map_base) {
    field_.squared_distances(T_map_base, hits_base_m_, squared_cells2_);
    const double sigma_cells = kScoreSigma_m / cell_m_;
    const auto factor = static_cast<float>(-0.5 / (sigma_cells * sigma_cells));
    return (factor * squared_cells2_).exp().sum();
  }

  double log_likelihood(const PlanarPose& T_map_base) {
    field_.squared_distances(T_map_base, hits_base_m_, squared_cells2_);
    double sum = 0.0;
    for (const float squared_cells2 : squared_cells2_) {
      sum += squared_cells2 < HitField::kNone / 2
                 ? -squared_cells2 * cell_m_ * cell_m_ / kLikelihoodSigma
                 : kNoHitLogLikelihood;
    }
    return sum;
  }

 private:
  const HitField& field_;
  double cell_m_;
  std::span<const Eigen::Vector2f> hits_base_m_;
  Eigen::ArrayXf squared_cells2_;
};

}  // namespace

HitField::HitField(const TileGrid& grid, const Eigen::Vector2d& centre_map_m, double reach_m)
    : cell_m_(grid.cell_m()) {
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(reach_m);
  const Cell beside = Cell::Ones();
  min_ = ((centre_map_m - reach) / cell_m_).array().floor().cast<int>().matrix() - beside;
  const Cell end =
      ((centre_map_m + reach) / cell_m_).array().floor().cast<int>().matrix() + 2 * beside;
  width_ = end.x() - min_.x();
  height_ = end.y() - min_.y();
  mean_hits_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_),
                    Eigen::Vector2f::Constant(kFarOff));
  const Cell first_tile = tile_of(min_);
  const Cell last_tile = tile_of(end - beside);
  for (int tile_y = first_tile.y(); tile_y <= last_tile.y(); ++tile_y) {
    for (int tile_x = first_tile.x(); tile_x <= last_tile.x(); ++tile_x) {
      const Tile* tile = grid.find({tile_x, tile_y});
      if (tile == nullptr) continue;
      const Cell from = (Tile::kCells * Cell(tile_x, tile_y)).cwiseMax(min_);
      const Cell to = (Tile::kCells * Cell(tile_x + 1, tile_y + 1)).cwiseMin(end);
      for (int y = from.y(); y < to.y(); ++y) {
        for (int x = from.x(); x < to.x(); ++x) {
          const std::size_t index = index_in_tile({x, y});
          if (!tile->is_occupied(index)) continue;
          const Cell offset = Cell(x, y) - min_;
          mean_hits_[static_cast<std::size_t>(offset.y()) * static_cast<std::size_t>(width_) +
                     static_cast<std::size_t>(offset.x())] =
              offset.cast<float>() + tile->mean_hit(index);
        }
      }
    }
  }
}

void HitField::squared_distances(const PlanarPose& T_map_base,
                                 std::span<const Eigen::Vector2f> hits_base_m,
                                 Eigen::ArrayXf& squared_cells2) const {
  squared_cells2.resize(static_cast<Eigen::Index>(hits_base_m.size()));
  const auto cells_per_m = static_cast<float>(1.0 / cell_m_);
  const float c = cells_per_m * static_cast<float>(std::cos(T_map_base.yaw_rad));
  const float s = cells_per_m * static_cast<float>(std::sin(T_map_base.yaw_rad));
  const auto base_x = static_cast<float>(T_map_base.x_m / cell_m_ - min_.x());
  const auto base_y = static_cast<float>(T_map_base.y_m / cell_m_ - min_.y());
  float* result = squared_cells2.data();
  for (const Eigen::Vector2f& hit_base_m : hits_base_m) {
    const float x = base_x + c * hit_base_m.x() - s * hit_base_m.y();
    const float y = base_y + s * hit_base_m.x() + c * hit_base_m.y();
    float nearest = kNone;
    if (x >= 1.0F && y >= 1.0F && x < static_cast<float>(width_ - 1) &&
        y < static_cast<float>(height_ - 1)) {
      const Eigen::Vector2f* row = &mean_hits_[static_cast<std::size_t>(static_cast<int>(y) - 1) *
                                                   static_cast<std::size_t>(width_) +
                                               static_cast<std::size_t>(static_cast<int>(x) - 1)];
      for (int i = 0; i < 3; ++i, row += width_) {
        for (int k = 0; k < 3; ++k) {
          const float dx = row[k].x() - x;
          const float dy = row[k].y() - y;
          nearest = std::min(nearest, dx * dx + dy * dy);
        }
      }
    }
    *result++ = nearest;
  }
}

ScanMatch match_scan(const TileGrid& grid, std::span<const Eigen::Vector2f> hits_base_m,
                     const PlanarPose& guess_T_map_base) {
  double farthest_m = 0.0;
  for (const Eigen::Vector2f& hit : hits_base_m) {
    farthest_m = std::max(farthest_m, static_cast<double>(hit.norm()));
  }
  const HitField field(grid, {guess_T_map_base.x_m, guess_T_map_base.y_m},
                       farthest_m + kClimbMax_m);
  ScanScore score(field, grid.cell_m(), hits_base_m);

  ScanMatch best{.T_map_base = guess_T_map_base, .score = score(guess_T_map_base)};
  double step = 1.0;
  for (int refinement = 0; refinement < kRefinements;) {
    // In the frame of the base: ahead, back, left, right, and turned to either side.
    const std::array<PlanarPose, 6> moves{{{step * kStep_m, 0.0, 0.0},
                                           {-step * kStep_m, 0.0, 0.0},
                                           {0.0, step * kStep_m, 0.0},
                                           {0.0, -step * kStep_m, 0.0},
                                           {0.0, 0.0, step * kStep_rad},
                                           {0.0, 0.0, -step * kStep_rad}}};
    const PlanarPose from = best.T_map_base;
    const double score_before = best.score;
    for (const PlanarPose& move : moves) {
      const PlanarPose T_map_base = from * move;
      const double score_there = score(T_map_base);
      if (score_there > best.score) {
        best.T_map_base = T_map_base;
        best.score = score_there;
      }
    }
    if (best.score > score_before) continue;
    ++refinement;
    step /= 2.0;
  }
  best.log_likelihood = score.log_likelihood(best.T_map_base);
  return best;
}

}  // namespace nbvopt
