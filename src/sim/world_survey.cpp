#include "nbvopt/sim/world_survey.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <tuple>
#include <utility>

#include "nbvopt/core/error.hpp"
#include "nbvopt/core/transform.hpp"
#include "sim/exploration/drive_region.hpp"
#include "sim/exploration/start_check.hpp"

namespace nbvopt {
namespace {

constexpr double kHeadroom_m = 1.0;
constexpr double kLevelHeight_m = 0.15;  // floors are not that uneven
constexpr double kLeastFloor_m2 = 2.0;
constexpr double kLeastShare = 0.1;
constexpr double kStartDistance_m = 2.0;
constexpr std::size_t kStarts = 5;

/// A place on a surface with air above it.
struct Candidate {
  Eigen::Vector3d position_map_m;
  bool is_outside;        ///< seen from the surface's outside, not from within a solid
  double enclosed = 0.0;  ///< the share of the lidar's beams that meet something
  double room_m = 0.0;    ///< 0: the base has no room
};

/// Places side by side and their level.
struct Level {
  FloorLevel floor;
  double walled_m2 = 0.0;  ///< of its area, weighted by how much is seen around: a roof has none
  std::vector<Candidate> free;
};

struct Columns {
  Eigen::AlignedBox3d box_m;
  double step_m;
};

Columns columns_over(const Eigen::AlignedBox3d& bounds_m) {
  constexpr double kColumns = 2500.0;
  constexpr double kFinest_m = 0.25;
  Columns columns{bounds_m, kFinest_m};
  if (bounds_m.isEmpty()) {
    columns.box_m = {Eigen::Vector3d::Constant(-5.0), Eigen::Vector3d::Constant(5.0)};
  }
  const Eigen::Vector3d size_m = columns.box_m.sizes();
  columns.step_m = std::max({kFinest_m, std::sqrt(size_m.x() * size_m.y() / kColumns),
                             size_m.head<2>().maxCoeff() / kColumns});
  return columns;
}

/// From above, the surfaces of one column on which something could stand.
void append_column(const Scene& scene, const Eigen::Vector3d& top_m,
                   std::vector<Candidate>& candidates) {
  constexpr int kSurfacesMax = 64;
  constexpr float kDeepest_m = 1000.0F;
  constexpr double kPast_m = 1e-3;  // the surface just met
  Eigen::Vector3d from_m = top_m;
  double ceiling_m = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kSurfacesMax; ++i) {
    const auto hit = scene.first_surface(from_m, -Eigen::Vector3f::UnitZ(), kDeepest_m);
    if (!hit) return;
    const double z_m = from_m.z() - hit->distance_m;
    if (ceiling_m - z_m >= kHeadroom_m) {
      candidates.push_back({{top_m.x(), top_m.y(), z_m}, hit->is_outside});
    }
    ceiling_m = z_m;
    from_m.z() = z_m - kPast_m;
  }
}

std::vector<Candidate> candidates_of(const Scene& scene, const Columns& columns) {
  std::vector<Candidate> candidates;
  const Eigen::Vector3d& min_m = columns.box_m.min();
  const Eigen::Vector3d& max_m = columns.box_m.max();
  for (double y_m = min_m.y() + 0.5 * columns.step_m; y_m < max_m.y(); y_m += columns.step_m) {
    for (double x_m = min_m.x() + 0.5 * columns.step_m; x_m < max_m.x(); x_m += columns.step_m) {
      append_column(scene, {x_m, y_m, max_m.z() + kHeadroom_m}, candidates);
    }
  }
  return candidates;
}

/// Candidates at like heights, from below, where they are many enough to be a floor.
std::vector<std::vector<Candidate>> levels_of(std::vector<Candidate> candidates, double step_m) {
  const auto height_of = [](const Candidate& c) { return c.position_map_m.z(); };
  std::ranges::stable_sort(candidates, {}, height_of);
  std::vector<std::vector<Candidate>> levels;
  for (Candidate& candidate : candidates) {
    if (levels.empty() ||
        height_of(candidate) - height_of(levels.back().front()) > kLevelHeight_m) {
      levels.emplace_back();
    }
    levels.back().push_back(std::move(candidate));
  }
  std::size_t widest = 0;
  for (const auto& level : levels) widest = std::max(widest, level.size());
  const double least =
      std::max(kLeastFloor_m2 / (step_m * step_m), kLeastShare * static_cast<double>(widest));
  std::erase_if(levels,
                [=](const auto& level) { return static_cast<double>(level.size()) < least; });
  return levels;
}

/// Looks around where the candidate stands.
void look_around(const SimulatedLidar& lidar, double least_room_m, Candidate& candidate) {
  const Eigen::Vector3d& position_m = candidate.position_map_m;
  const std::vector<float> ranges_m =
      lidar.scan(base_pose(position_m.x(), position_m.y(), position_m.z(), 0.0));
  const double nearest_m = *std::ranges::min_element(ranges_m);
  if (nearest_m < least_room_m) return;
  candidate.room_m = std::min(nearest_m, lidar.options().range_max_m);
  const auto seen = std::ranges::count_if(ranges_m, [](float r) { return std::isfinite(r); });
  candidate.enclosed = static_cast<double>(seen) / static_cast<double>(ranges_m.size());
}

Level level_of(std::vector<Candidate> candidates, const SimulatedLidar& lidar,
               const ExplorationOptions& options, double step_m) {
  Level level;
  level.floor.height_m = candidates[candidates.size() / 2].position_map_m.z();
  for (Candidate& candidate : candidates) {
    look_around(lidar, options.base.radius_m + options.cell_m, candidate);
  }
  std::erase_if(candidates, [](const Candidate& candidate) { return candidate.room_m <= 0.0; });
  level.floor.area_m2 = step_m * step_m * static_cast<double>(candidates.size());
  for (const Candidate& candidate : candidates) {
    level.walled_m2 += step_m * step_m * candidate.enclosed;
  }
  level.free = std::move(candidates);
  std::ranges::stable_sort(level.free, std::greater{}, [](const Candidate& candidate) {
    return std::tuple(candidate.is_outside, std::round(10.0 * candidate.enclosed),
                      candidate.room_m);
  });
  return level;
}

bool is_free(const Scene& scene, const Eigen::Vector3d& position_m,
             const ExplorationOptions& options) {
  if (!DriveRegion(options).contains(position_m.head<2>())) return false;
  try {
    require_free_start(scene, base_pose(position_m.x(), position_m.y(), position_m.z(), 0.0),
                       options);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

void append_starts(const Scene& scene, const ExplorationOptions& options, const Level& level,
                   std::size_t count, std::vector<StartPlace>& starts) {
  for (const Candidate& candidate : level.free) {
    if (count == 0) return;
    const Eigen::Vector3d& position_m = candidate.position_map_m;
    const bool is_apart = std::ranges::all_of(starts, [&](const StartPlace& start) {
      return (start.position_map_m - position_m).norm() >= kStartDistance_m;
    });
    if (!is_apart || !is_free(scene, position_m, options)) continue;
    starts.push_back({position_m, candidate.room_m});
    --count;
  }
}

}  // namespace

WorldSurvey survey_world(const Scene& scene, const Eigen::AlignedBox3d& bounds_m,
                         const ExplorationOptions& options) {
  const SimulatedLidar lidar(scene, options.lidar);
  const Columns columns = columns_over(bounds_m);
  std::vector<Level> levels;
  for (auto& candidates : levels_of(candidates_of(scene, columns), columns.step_m)) {
    levels.push_back(level_of(std::move(candidates), lidar, options, columns.step_m));
  }
  WorldSurvey survey;
  double roomiest_m2 = 0.0;
  for (const Level& level : levels) {
    survey.floors.push_back(level.floor);
    roomiest_m2 = std::max(roomiest_m2, level.walled_m2);
  }
  std::stable_partition(levels.begin(), levels.end(),
                        [=](const Level& level) { return level.walled_m2 >= 0.5 * roomiest_m2; });
  for (std::size_t i = 0; i < levels.size(); ++i) {
    append_starts(scene, options, levels[i], i == 0 ? kStarts : 1, survey.starts);
  }
  return survey;
}

}  // namespace nbvopt
