// One version of the map, as plans see it.
#pragma once

#include <memory>

#include "nbvopt/planner/planner.hpp"

namespace nbvopt {

/// Immutable, and safe to share between threads.
class PublishedMap {
 public:
  PublishedMap(const Robot& robot, std::shared_ptr<const VoxelGrid> grid)
      : grid_(std::move(grid)),
        evaluator_(make_exact_evaluator(grid_, DepthCamera(robot.sensor))),
        planner_(robot, grid_, evaluator_) {}

  std::uint64_t version() const { return grid_->version(); }
  const VoxelGrid& grid() const { return *grid_; }
  const ViewEvaluator& evaluator() const { return *evaluator_; }
  const Planner& planner() const { return planner_; }

 private:
  std::shared_ptr<const VoxelGrid> grid_;
  std::shared_ptr<const ViewEvaluator> evaluator_;
  Planner planner_;
};

}  // namespace nbvopt
