#include "solvers/backends/random.hpp"

#include <optional>
#include <random>

#include "core/uniform.hpp"
#include "solvers/batch_search.hpp"
#include "solvers/stop_status.hpp"
#include "solvers/unit_box.hpp"

namespace nbvopt {

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

}  // namespace nbvopt
