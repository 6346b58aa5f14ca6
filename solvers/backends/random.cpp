// Uniform random sampling: the search that every other must beat.
#include <optional>
#include <random>

#include "core/uniform.hpp"
#include "solvers/answer.hpp"
#include "solvers/batch_search.hpp"
#include "solvers/families.hpp"
#include "solvers/unit_box.hpp"

namespace nbvopt {
namespace {

/// Evaluates the start, then points drawn uniformly from the box. A seed draws the same points
/// with every standard library.
class RandomSolver final : public Solver {
 public:
  std::string name() const override { return "random"; }

 private:
  SolveResult do_solve(const Objective& objective, const SolveRequest& request) const override;
};

SolveResult RandomSolver::do_solve(const Objective& objective, const SolveRequest& request) const {
  const UnitBox unit_box(objective.box(), request.start);
  std::mt19937_64 generator(request.seed);
  const auto next_candidate = [&]() -> std::optional<Point> {
    if (unit_box.dimension() == 0) return std::nullopt;  // the start is all there is
    Point u(unit_box.dimension());
    for (double& coordinate : u) coordinate = uniform(generator);
    return unit_box.from_unit(u);
  };
  return batch_search(objective, bounded(request, unit_box.dimension()), next_candidate,
                      SolveStatus::converged);
}

}  // namespace

SolverFamily random_family() {
  return {.label = "random",
          .names = {"random"},
          .heeds = std::nullopt,
          .make = [](const std::string&, const Search&) -> std::unique_ptr<Solver> {
            return std::make_unique<RandomSolver>();
          }};
}

}  // namespace nbvopt
