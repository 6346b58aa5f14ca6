#include "gain/gain_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "gain/angle_part.hpp"
#include "nbvopt/sensor/uncertainty_model.hpp"

namespace nbvopt::detail {
namespace {

/// Of cells at level 0.
constexpr double kCoarsest_rad = 0.08;
/// How high a slab is for each radian of a cell's width: moving the camera by a slab shifts what is
/// this far away by a cell, and what rays hit is two to four metres away.
constexpr double kSlabPerCell_m_rad = 4.0;
/// A cell is then a fortieth of a ray's spacing.
constexpr int kDeepestLevel = 7;

constexpr std::size_t kMostCellBytes = std::size_t{256} << 20;

/// Of places of the camera, metres.
constexpr double kPlaceRounding_m = 1e-9;

CellBox united(const CellBox& a, const CellBox& b) {
  return {.azimuth_min = std::min(a.azimuth_min, b.azimuth_min),
          .azimuth_max = std::max(a.azimuth_max, b.azimuth_max),
          .elevation_min = std::min(a.elevation_min, b.elevation_min),
          .elevation_max = std::max(a.elevation_max, b.elevation_max)};
}

}  // namespace

float BoundBlock::largest() const { return *std::max_element(bounds.begin(), bounds.end()); }

GainBound::GainBound(const VoxelGrid& grid, const SensorOptions& sensor, const MovingMast& mast,
                     const JointBox& box)
    : lattice_(grid.lattice()),
      camera_(sensor),
      mast_(mast),
      box_(box),
      block_bins_([&] {
        const MastOptions& options = mast.mast().options();
        const double lever_m = options.sensor_offset_m.norm() +
                               mast.mast_twist().speed_m_s() / std::min(options.tilt_velocity_rad_s,
                                                                        options.pan_velocity_rad_s);
        // Turning through a block is to move the camera by no more than a slab.
        const double bins = kSlabPerCell_m_rad / lever_m;
        return bins < 1 << 20 ? std::max(1, static_cast<int>(bins)) : 1 << 20;
      }()),
      cones_grid_([&] {
        const auto [low, high] = origins_m(box);
        const Eigen::Vector3d reach = Eigen::Vector3d::Constant(sensor.longest_range_m());
        return ConeGrid(grid, lattice_.to_lattice(low - reach), lattice_.to_lattice(high + reach));
      }()),
      march_(cones_grid_, camera_, lattice_.resolution_m(), grid.carries_uncertainty()) {
  const UncertaintyModel uncertainty(sensor);
  for (const double part : angle_part(uncertainty, camera_.rays())) {
    angle_part_.push_back(std::nextafter(static_cast<float>(part), 0.0F));
  }
}

double GainBound::cell_rad(int level) const { return std::ldexp(kCoarsest_rad, -level); }

double GainBound::slab_m(int level) const { return kSlabPerCell_m_rad * cell_rad(level); }

int GainBound::bins(int joint, int level) const {
  const double width = box_.max[joint] - box_.min[joint];
  const double bin = joint == 2 ? slab_m(level) : cell_rad(level);
  return std::max(1, static_cast<int>(std::ceil(width / bin)));
}

std::vector<BoundBlock> GainBound::cut(int level, const std::array<int, 3>& first,
                                       const std::array<int, 3>& end) const {
  std::vector<BoundBlock> blocks;
  for (int height = first[2]; height < end[2]; ++height) {
    for (int tilt = first[1]; tilt < end[1]; tilt += block_bins_) {
      for (int pan = first[0]; pan < end[0]; pan += block_bins_) {
        BoundBlock block;
        block.level = level;
        block.first = {pan, tilt, height};
        block.pans = std::min(block_bins_, end[0] - pan);
        block.tilts = std::min(block_bins_, end[1] - tilt);
        block.pan_end = block.pans;
        block.tilt_end = block.tilts;
        blocks.push_back(std::move(block));
      }
    }
  }
  return blocks;
}

std::vector<BoundBlock> GainBound::roots() const {
  // A ray brings at most what it brings where it meets the unknown at the focal distance.
  double most = 0.0;
  for (const float part : angle_part_) most += kUnknownUncertainty - part;
  std::vector<BoundBlock> blocks = cut(0, {0, 0, 0}, {bins(0, 0), bins(1, 0), bins(2, 0)});
  for (BoundBlock& block : blocks) {
    block.bounds.assign(
        static_cast<std::size_t>(block.pans) * static_cast<std::size_t>(block.tilts),
        std::nextafter(static_cast<float>(most), std::numeric_limits<float>::infinity()));
  }
  return blocks;
}

/// The bins of a block that are worth a closer look: by row the first and the last of them.
struct GainBound::Alive {
  Alive(const BoundBlock& block, float worth) {
    for (int t = block.tilt_begin; t < block.tilt_end; ++t) {
      const float* bounds = block.row(t) - block.pan_begin;
      int begin = block.pan_begin;
      int end = block.pan_end;
      while (begin < end && bounds[begin] <= worth) ++begin;
      while (end > begin && bounds[end - 1] <= worth) --end;
      if (begin == end) continue;
      rows.push_back({t, begin, end});
      pan_begin = std::min(pan_begin, begin);
      pan_end = std::max(pan_end, end);
    }
  }
  struct Row {
    int tilt, begin, end;
  };
  std::vector<Row> rows;
  int pan_begin = std::numeric_limits<int>::max(), pan_end = 0;
};

std::vector<BoundBlock> GainBound::children(const BoundBlock& block, float worth) const {
  const Alive alive(block, worth);
  if (block.level >= kDeepestLevel || alive.rows.empty()) return {};
  const int level = block.level + 1;
  const std::array<int, 3> counts{block.pans, block.tilts, 1};
  std::array<int, 3> first{};
  std::array<int, 3> end{};
  for (int j = 0; j < 3; ++j) {
    first[j] = 2 * block.first[j];
    end[j] = std::min(2 * (block.first[j] + counts[j]), bins(j, level));
  }
  const auto known =
      cells_.find(BlockKey{block.level, block.first[0], block.first[1], block.first[2]});
  std::vector<BoundBlock> blocks = cut(level, first, end);
  for (BoundBlock& child : blocks) {
    if (known != cells_.end()) child.coarser = known->second;
    // From the child's bins to its parent's, and back.
    const int pan_shift = child.first[0] - first[0];
    const int tilt_shift = child.first[1] - first[1];
    child.pan_begin = std::clamp(2 * alive.pan_begin - pan_shift, 0, child.pans);
    child.pan_end = std::clamp(2 * alive.pan_end - pan_shift, 0, child.pans);
    child.tilt_begin = std::clamp(2 * alive.rows.front().tilt - tilt_shift, 0, child.tilts);
    child.tilt_end = std::clamp(2 * (alive.rows.back().tilt + 1) - tilt_shift, 0, child.tilts);
    child.bounds.resize(static_cast<std::size_t>(child.pan_end - child.pan_begin) *
                        static_cast<std::size_t>(child.tilt_end - child.tilt_begin));
    if (child.bounds.empty()) continue;
    for (int t = child.tilt_begin; t < child.tilt_end; ++t) {
      const float* parents = block.row((t + tilt_shift) / 2) - block.pan_begin;
      float* bounds = child.row(t) - child.pan_begin;
      for (int p = child.pan_begin; p < child.pan_end; ++p)
        bounds[p] = parents[(p + pan_shift) / 2];
    }
  }
  std::erase_if(blocks, [](const BoundBlock& child) { return child.bounds.empty(); });
  return blocks;
}

JointBox GainBound::box_of(const BoundBlock& block, int pan, int tilt) const {
  const double bin = cell_rad(block.level);
  JointBox box;
  box.min[0] = box_.min[0] + bin * (block.first[0] + pan);
  box.max[0] = box_.min[0] + bin * (block.first[0] + pan + 1);
  box.min[1] = box_.min[1] + bin * (block.first[1] + tilt);
  box.max[1] = box_.min[1] + bin * (block.first[1] + tilt + 1);
  box.min[2] = std::min(box_.max[2], box_.min[2] + slab_m(block.level) * block.first[2]);
  box.max[2] = std::min(box_.max[2], box_.min[2] + slab_m(block.level) * (block.first[2] + 1));
  return box;
}

JointBox GainBound::box_of(const BoundBlock& block) const {
  JointBox box = box_of(block, 0, 0);
  const JointBox last = box_of(block, block.pans - 1, block.tilts - 1);
  box.max = last.max.cwiseMin(box_.max).cwiseMax(box.min);
  return box;
}

std::pair<double, double> GainBound::arrival_times_s(const JointBox& box) const {
  const Eigen::Array3d q = mast_.joints().vector().array();
  const Eigen::Array3d velocity = mast_.mast().velocity().array();
  const Eigen::Array3d nearest = (box.min.array() - q).max(q - box.max.array()).max(0.0) / velocity;
  const Eigen::Array3d farthest =
      (box.min.array() - q).abs().max((box.max.array() - q).abs()) / velocity;
  return {nearest.maxCoeff(), farthest.maxCoeff()};
}

std::pair<double, double> GainBound::turns_rad(const JointBox& box) const {
  const double turn_rad_s = mast_.mast_twist().wz_rad_s;
  const auto [first_s, last_s] = arrival_times_s(box);
  return std::minmax(turn_rad_s * first_s, turn_rad_s * last_s);
}

std::pair<Eigen::Vector3d, Eigen::Vector3d> GainBound::origins_m(const JointBox& box) const {
  const auto [first_s, last_s] = arrival_times_s(box);
  const Eigen::Vector3d middle = 0.5 * (box.min + box.max);
  const Transform T_map_mast = mast_.T_map_mast(0.5 * (first_s + last_s));
  const Eigen::Vector3d centre =
      T_map_mast * mast_.mast().T_mast_sensor(JointPosition::from(middle)).translation();
  // How far the joints and the base's way take the camera from there, along the mast and across.
  const Eigen::Vector3d half = 0.5 * (box.max - box.min);
  const BaseTwist& twist = mast_.mast_twist();
  const double half_s = 0.5 * (last_s - first_s);
  const double lever_m = mast_.mast().options().sensor_offset_m.norm();
  const double around_m = twist.speed_m_s() * half_s +
                          lever_m * (half[0] + half[1] + std::abs(twist.wz_rad_s) * half_s);
  const Eigen::Vector3d reach = half[2] * T_map_mast.linear().col(2).cwiseAbs() +
                                Eigen::Vector3d::Constant(around_m + kPlaceRounding_m);
  return {centre - reach, centre + reach};
}

const RayRanges& GainBound::ranges_of(int level, int tilt) {
  const auto found = ranges_.find({level, tilt});
  if (found != ranges_.end()) return found->second;
  const double cell = cell_rad(level);
  const double from_rad = box_.min[1] + cell * tilt;
  const double to_rad = std::clamp(from_rad + cell, from_rad, std::max(from_rad, box_.max[1]));
  return ranges_.try_emplace({level, tilt}, camera_.rays(), from_rad, to_rad, cell).first->second;
}

CellBox GainBound::seen_from(const BoundBlock& block, int tilt, int begin, int end,
                             const std::pair<double, double>& turn_cells) {
  return detail::seen_from(ranges_of(block.level, block.first[1] + tilt), block.first[0] + begin,
                           block.first[0] + end, turn_cells);
}

ConeCells& GainBound::cells_of(const BoundBlock& block,
                               const std::pair<double, double>& turn_cells) {
  std::shared_ptr<ConeCells>& cells =
      cells_[{block.level, block.first[0], block.first[1], block.first[2]}];
  if (cells) return *cells;
  // Rays go highest, lowest and farthest aside at the ends of the tilts.
  const CellBox all = united(seen_from(block, 0, 0, block.pans, turn_cells),
                             seen_from(block, block.tilts - 1, 0, block.pans, turn_cells));
  const CellFrame frame{mast_.T_map_mast(0.0).linear(), box_.min[0], cell_rad(block.level)};
  const auto [low_m, high_m] = origins_m(box_of(block));
  cells = std::make_shared<ConeCells>(frame, all, lattice_.to_lattice(low_m) - cones_grid_.corner(),
                                      lattice_.to_lattice(high_m) - cones_grid_.corner());
  return *cells;
}

bool GainBound::tighten(BoundBlock& block, float worth, const StopRule& stop) {
  const Alive alive(block, worth);
  if (alive.rows.empty()) return true;
  const double cell = cell_rad(block.level);
  const auto [turn_min_rad, turn_max_rad] = turns_rad(box_of(block));
  const std::pair<double, double> turn_cells{turn_min_rad / cell, turn_max_rad / cell};

  ConeCells& cells = cells_of(block, turn_cells);
  std::optional<CellBox> part;
  for (const Alive::Row& row : alive.rows) {
    const CellBox seen = seen_from(block, row.tilt, row.begin, row.end, turn_cells);
    part = part ? united(*part, seen) : seen;
    const std::int64_t cones = cells.cones();
    const std::size_t bytes = cells.memory_bytes();
    const bool is_filled = cells.fill(seen, block.coarser.get(), cones_grid_, march_, stop);
    cones_ += cells.cones() - cones;
    cell_bytes_ += cells.memory_bytes() - bytes;
    if (!is_filled || cones_ >= stop.max_evaluations || cell_bytes_ > kMostCellBytes) return false;
  }

  const std::vector<float> windows = cells.windows(*part);
  // Sums of single precision are off by no more.
  const float rounding =
      1.0F + std::numeric_limits<float>::epsilon() * static_cast<float>(angle_part_.size());
  std::vector<float> sums(static_cast<std::size_t>(block.pans));
  for (const Alive::Row& row : alive.rows) {
    if (stop.is_expired() || stop.cancel.is_cancelled()) return false;
    const RayWindows rays = windows_of(ranges_of(block.level, block.first[1] + row.tilt),
                                       turn_cells, *part, angle_part_);
    bound_row(rays, windows.data() + block.first[0], row.begin, row.end, sums.data());
    float* bounds = block.row(row.tilt) - block.pan_begin;
    for (int p = row.begin; p < row.end; ++p) {
      bounds[p] = std::min(bounds[p], sums[static_cast<std::size_t>(p - row.begin)] * rounding);
    }
  }
  return true;
}

}  // namespace nbvopt::detail
