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

  /// The robot, the view that it has and the one that the answer chooses; `planner` has the map.
  /// Throws InputError where the answer's joints or base cannot be those of the planner's robot.
  void add_answer(const AnswerFile& answer, const ViewPlanner& planner);

  std::uint64_t faces() const { return faces_; }            ///< of occupied voxels
  std::uint64_t rectangles() const { return rectangles_; }  ///< that they were merged into

  std::string html() const;

 private:
  std::string name_;
  Json data_;
  std::vector<PageBlock> blocks_;
  std::uint64_t faces_ = 0;
  std::uint64_t rectangles_ = 0;
};

}  // namespace nbvopt
