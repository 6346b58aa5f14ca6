// The paper's discretised search, Algorithms 1 and 2.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <sstream>
#include <utility>

#include "nbvopt/core/error.hpp"
#include "nbvopt/solver/grid_coordinates.hpp"
#include "solvers/batch_search.hpp"
#include "solvers/families.hpp"

namespace nbvopt {
namespace {

/// A step that ends this share of itself past the upper end still counts: it is rounding.
constexpr double kEndTolerance = 1e-9;

/// Algorithm 2, line 7: GetNumberOfPoses, of one coordinate.
double pose_count(double lower, double upper, double step) {
  return std::floor((upper - lower) / step + kEndTolerance) + 1.0;
}

/// Algorithm 2, line 9: GetPose, of one coordinate. Never accumulated.
double pose(double lower, double upper, double step, std::int64_t i) {
  return std::min(lower + static_cast<double>(i) * step, upper);
}

/// The points of Algorithm 2, GetPossiblePoses, without the current one; the last coordinate runs
/// fastest.
class CandidateLattice {
 public:
  CandidateLattice(const Box& box, const Point& start, const std::vector<double>& steps)
      : box_(box), start_(start), steps_(steps), index_(steps.size(), 0) {
    for (std::size_t i = 0; i < steps.size(); ++i) counts_.push_back(count(i));
  }

  /// Not an integer, so that absurd steps do not overflow.
  double size() const {
    double product = 1.0;
    for (const double count : counts_) product *= count;
    return product;
  }

  std::optional<Point> next() {
    if (is_spent_) return std::nullopt;
    Point point(start_.size());
    for (std::size_t i = 0; i < steps_.size(); ++i) point[i] = coordinate(i);
    advance();
    return point;
  }

 private:
  double count(std::size_t i) const {
    return steps_[i] == 0.0 ? 1.0 : pose_count(box_.lower[i], box_.upper[i], steps_[i]);
  }

  double coordinate(std::size_t i) const {
    return steps_[i] == 0.0 ? start_[i] : pose(box_.lower[i], box_.upper[i], steps_[i], index_[i]);
  }

  void advance() {
    for (std::size_t i = steps_.size(); i-- > 0;) {
      if (++index_[i] < counts_[i]) return;
      index_[i] = 0;
    }
    is_spent_ = true;
  }

  const Box& box_;
  const Point& start_;
  const std::vector<double>& steps_;
  std::vector<double> counts_;
  std::vector<std::int64_t> index_;
  bool is_spent_ = false;
};

/// Evaluates the start and every point of a lattice over the box, and takes the best. The lattice
/// begins at the box's lower end; a coordinate whose step is 0 stays at the start's value.
class GridSolver final : public Solver {
 public:
  static constexpr double kMaxCandidates = 1e7;

  /// One step a coordinate. Throws UsageError when one is negative or not finite.
  explicit GridSolver(std::vector<double> steps);

  std::string name() const override { return "grid"; }

 private:
  /// Throws UsageError when there is not one step a coordinate, or more than kMaxCandidates.
  SolveResult do_solve(const Objective& objective, const SolveRequest& request) const override;

  std::vector<double> steps_;
};

}  // namespace

std::vector<double> grid_coordinates(double lower, double upper, double step) {
  std::vector<double> coordinates;
  const double count = pose_count(lower, upper, step);
  for (std::int64_t i = 0; static_cast<double>(i) < count; ++i) {
    coordinates.push_back(pose(lower, upper, step, i));
  }
  return coordinates;
}

GridSolver::GridSolver(std::vector<double> steps) : steps_(std::move(steps)) {
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    if (std::isfinite(steps_[i]) && steps_[i] >= 0.0) continue;
    std::ostringstream text;
    text << "grid_steps[" << i << "] = " << steps_[i]
         << ": give a finite step above 0, or 0 to freeze the coordinate";
    throw UsageError(text.str());
  }
}

SolveResult GridSolver::do_solve(const Objective& objective, const SolveRequest& request) const {
  const Box& box = objective.box();
  if (steps_.size() != static_cast<std::size_t>(box.dimension())) {
    throw UsageError("grid_steps: " + std::to_string(steps_.size()) + " given, " +
                     std::to_string(box.dimension()) + " needed, one a coordinate");
  }
  CandidateLattice lattice(box, request.start, steps_);
  if (lattice.size() > kMaxCandidates) {
    std::ostringstream text;
    text << "grid_steps: " << lattice.size() << " candidates, more than " << kMaxCandidates
         << ": give larger steps";
    throw UsageError(text.str());
  }
  // Algorithm 1; the start is evaluated by batch_search (Algorithm 2, line 1: Q = {q}) and left
  // out where the lattice meets it again.
  const auto next_candidate = [&] {
    std::optional<Point> candidate = lattice.next();
    return candidate == request.start ? lattice.next() : candidate;
  };
  return batch_search(objective, request, next_candidate, SolveStatus::grid_complete);
}

SolverFamily grid_family() {
  return {.label = "grid",
          .names = {"grid"},
          .heeds = SearchParameters::grid_steps,
          .make = [](const std::string&, const Search& search) -> std::unique_ptr<Solver> {
            return std::make_unique<GridSolver>(search.grid_steps);
          }};
}

}  // namespace nbvopt
