// The page of a map: its surfaces, and what a planner said on it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "nbvopt/map/uncertainty_map.hpp"
#include "nbvopt/planner/view_planner.hpp"
#include "web/answer_file.hpp"
#include "web/page.hpp"

namespace nbvopt {

/// Gathers what a page shows, then writes it.
class MapPage {
 public:
  /// The map, or the part of it in `box`; `name` is what it is called. Throws InputError as
  /// surface_mesh() does.
  MapPage(const std::string& name, const UncertaintyMap& map, const std::optional<KeyBox>& box);

  /// The robot, the view that it has and the one that the answer chooses, the gain over pan and
  /// tilt around it, and of the exact positive gain the voxels that it comes from; `planner` has
  /// the map. Throws InputError where the answer's request cannot be one to the planner's robot.
  void add_answer(const AnswerFile& answer, const ViewPlanner& planner);

  std::uint64_t faces() const { return faces_; }            ///< of occupied voxels
  std::uint64_t rectangles() const { return rectangles_; }  ///< that they were merged into

  std::string html() const;

 private:
  void add_landscape(const AnswerFile& answer, const ViewPlanner& planner);
  void add_voxel_gains(const Transform& T_map_sensor, const ViewPlanner& planner);

  std::string name_;
  Json data_;
  std::vector<PageBlock> blocks_;
  std::uint64_t faces_ = 0;
  std::uint64_t rectangles_ = 0;
};

}  // namespace nbvopt
