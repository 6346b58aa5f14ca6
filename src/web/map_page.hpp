// The page of a map: its surfaces, and what a planner said on it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "nbvopt/map/uncertainty_map.hpp"
#include "nbvopt/planner/view_planner.hpp"
#include "web/answer_file.hpp"
#include "web/episode_file.hpp"
#include "web/page.hpp"
#include "web/surface_mesh.hpp"

namespace nbvopt {

/// What a page tells of a map.
Json map_json(const std::string& name, const Lattice& lattice, bool carries_uncertainty,
              const MapCounts& counts);

/// Gathers what a page shows, then writes it.
class MapPage {
 public:
  /// The map, or the part of it in `box`; `name` is what it is called. Throws InputError as
  /// surface_mesh() does.
  MapPage(const std::string& name, const UncertaintyMap& map, const std::optional<KeyBox>& box);

  /// The robot, the view that it has and the one that the answer chooses, the gain over pan and
  /// tilt around it, and the voxels that it comes from; `planner` has the map. Throws InputError
  /// where the answer's request cannot be one to the planner's robot.
  void add_answer(const AnswerFile& answer, const ViewPlanner& planner);

  /// The drive of an episode whose map this is, and when it first saw which voxel; `grid` is the
  /// map's. Throws InputError as first_captures() does.
  void add_episode(const std::vector<EpisodeCapture>& captures, const VoxelGrid& grid,
                   const Robot& robot);

  /// Of occupied voxels.
  std::uint64_t faces() const { return mesh_.seen.faces + mesh_.backs.faces; }
  /// That these were merged into.
  std::uint64_t rectangles() const {
    return mesh_.seen.rectangles.size() + mesh_.backs.rectangles.size();
  }

  std::string html() const;

 private:
  std::string name_;
  SurfaceMesh mesh_;
  Json data_;
  std::vector<PageBlock> blocks_;
};

}  // namespace nbvopt
