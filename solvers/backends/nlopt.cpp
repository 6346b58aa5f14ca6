// The algorithms of the NLopt library.
#include <nlopt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <sstream>
#include <string_view>
#include <type_traits>

#include "nbvopt/core/error.hpp"
#include "solvers/answer.hpp"
#include "solvers/families.hpp"
#include "solvers/tracked_objective.hpp"
#include "solvers/unit_box.hpp"

namespace nbvopt {
namespace {

/// NLopt's own choice of a first step in a unit box.
constexpr double kLargestStep = 0.25;

struct Algorithm {
  std::string_view name;
  nlopt_algorithm native;
  bool needs_gradient;
};

constexpr std::array kAlgorithms{
    Algorithm{"nlopt:direct-l", NLOPT_GN_DIRECT_L, false},
    Algorithm{"nlopt:crs2", NLOPT_GN_CRS2_LM, false},
    Algorithm{"nlopt:isres", NLOPT_GN_ISRES, false},
    Algorithm{"nlopt:esch", NLOPT_GN_ESCH, false},
    Algorithm{"nlopt:mlsl-lds", NLOPT_G_MLSL_LDS, false},
    Algorithm{"nlopt:stogo", NLOPT_GD_STOGO, true},
    Algorithm{"nlopt:ags", NLOPT_GN_AGS, false},
    Algorithm{"nlopt:lbfgs", NLOPT_LD_LBFGS, true},
    Algorithm{"nlopt:slsqp", NLOPT_LD_SLSQP, true},
    Algorithm{"nlopt:mma", NLOPT_LD_MMA, true},
    Algorithm{"nlopt:bobyqa", NLOPT_LN_BOBYQA, false},
    Algorithm{"nlopt:sbplx", NLOPT_LN_SBPLX, false},
    Algorithm{"nlopt:cobyla", NLOPT_LN_COBYLA, false},
};

const Algorithm& algorithm(std::string_view name) {
  const auto* const found =
      std::find_if(kAlgorithms.begin(), kAlgorithms.end(),
                   [&](const Algorithm& candidate) { return candidate.name == name; });
  if (found == kAlgorithms.end()) {
    throw UsageError("solver \"" + std::string(name) + "\" is not an algorithm of NLopt");
  }
  return *found;
}

using NloptHandle = std::unique_ptr<std::remove_pointer_t<nlopt_opt>, decltype(&nlopt_destroy)>;

NloptHandle create(nlopt_algorithm native, const Point& tolerance) {
  NloptHandle handle(nlopt_create(native, static_cast<unsigned>(tolerance.size())), &nlopt_destroy);
  if (!handle) throw std::bad_alloc();
  // A step tolerance always: COBYLA can hang without one.
  nlopt_set_xtol_abs(handle.get(), tolerance.data());
  return handle;
}

/// What NLopt minimises: the negative value over the unit box.
class Callback {
 public:
  Callback(TrackedObjective& tracked, const UnitBox& unit_box, nlopt_opt handle, double start_value)
      : tracked_(tracked),
        unit_box_(unit_box),
        handle_(handle),
        worst_cost_(std::isfinite(start_value) ? -start_value : 0.0) {}

  static double call(unsigned dimension, const double* u, double* gradient, void* callback) {
    return static_cast<Callback*>(callback)->cost({u, dimension}, gradient);
  }

 private:
  double cost(const Eigen::Map<const Point>& u, double* gradient) {
    Eigen::Map<Point> unit_gradient(gradient, gradient ? u.size() : 0);
    unit_gradient.setZero();
    if (!u.allFinite()) return worst_cost_;
    const Evaluation* evaluation = tracked_.evaluate(unit_box_.from_unit(u));
    if (!evaluation) return stop();
    if (!std::isfinite(evaluation->value)) return worst_cost_;
    if (gradient && evaluation->gradient.allFinite()) {
      unit_gradient = -unit_box_.unit_gradient(evaluation->gradient);
    }
    worst_cost_ = std::max(worst_cost_, -evaluation->value);
    return -evaluation->value;
  }

  /// StoGO, and CRS2 while it fills its population, do not see a forced stop, but see a cost below
  /// the stop value.
  double stop() {
    nlopt_force_stop(handle_);
    return -std::numeric_limits<double>::infinity();
  }

  TrackedObjective& tracked_;
  const UnitBox& unit_box_;
  nlopt_opt handle_;
  /// Stands for a cost that is not finite, which would poison NLopt's models.
  double worst_cost_;
};

/// NLopt's own limit. The tracked objective's holds first; this one ends a search that asks again
/// and again for points that cost no evaluation: repeated ones, or NaN.
int max_requests(const StopRule& stop) {
  constexpr std::int64_t kMaxEvaluations = std::numeric_limits<int>::max() / 10;
  return static_cast<int>(10 * std::min(stop.max_evaluations, kMaxEvaluations));
}

/// Of a search that the stop rule did not end.
SolveStatus status_of(nlopt_result code) {
  switch (code) {
    case NLOPT_INVALID_ARGS:
      throw UsageError("NLopt refused the problem: use another solver");
    case NLOPT_OUT_OF_MEMORY:
      throw std::bad_alloc();
    case NLOPT_ROUNDOFF_LIMITED:  // nothing is left to gain in double precision
    case NLOPT_SUCCESS:
    case NLOPT_FTOL_REACHED:
    case NLOPT_XTOL_REACHED:
      return SolveStatus::converged;
    default:
      return SolveStatus::stalled;
  }
}

double checked_initial_step(double initial_step) {
  if (std::isfinite(initial_step) && initial_step >= 0.0) return initial_step;
  std::ostringstream text;
  text << "initial_step = " << initial_step
       << ": give length scales, 0 or more, or 0 for the solver's own choice";
  throw UsageError(text.str());
}

/// One NLopt algorithm, run over the unit box of the coordinates that can move.
///
/// Global: direct-l, crs2, isres, esch, mlsl-lds, ags; with gradient, stogo.
/// Local: bobyqa, sbplx, cobyla; with gradient, lbfgs, slsqp, mma.
/// mlsl-lds starts L-BFGS where the objective has a gradient, else BOBYQA.
class NloptSolver final : public Solver {
 public:
  /// `name` is one of the above after "nlopt:"; `tolerance` and `initial_step` as in Search.
  /// Throws UsageError when the tolerance is not above 0 and finite, or the step not
  /// 0 or more and finite.
  NloptSolver(const std::string& name, double tolerance, double initial_step);

  std::string name() const override { return name_; }
  SolverNeeds needs() const override;

 private:
  SolveResult do_solve(const Objective& objective, const SolveRequest& request) const override;

  std::string name_;
  double tolerance_;
  double initial_step_;
};

}  // namespace

NloptSolver::NloptSolver(const std::string& name, double tolerance, double initial_step)
    : name_(algorithm(name).name),
      tolerance_(checked_tolerance(tolerance)),
      initial_step_(checked_initial_step(initial_step)) {}

SolverNeeds NloptSolver::needs() const { return {.gradient = algorithm(name_).needs_gradient}; }

SolveResult NloptSolver::do_solve(const Objective& objective, const SolveRequest& request) const {
  const UnitBox unit_box(objective.box(), request.start);
  const SolveRequest bounded_request = bounded(request, unit_box.dimension());
  const nlopt_algorithm native = algorithm(name_).native;
  const bool is_multistart = native == NLOPT_G_MLSL_LDS;
  const bool uses_gradient = needs().gradient || (is_multistart && objective.has_gradient());

  TrackedObjective tracked(objective, bounded_request, {.gradient = uses_gradient});
  if (unit_box.dimension() == 0) return tracked.result(SolveStatus::converged);

  const Point scale = unit_box.unit_scale(objective);
  const Point tolerance = tolerance_ * scale;
  const NloptHandle handle = create(native, tolerance);
  Callback callback(tracked, unit_box, handle.get(), tracked.evaluate(request.start)->value);
  nlopt_set_min_objective(handle.get(), &Callback::call, &callback);
  nlopt_set_lower_bounds1(handle.get(), 0.0);
  nlopt_set_upper_bounds1(handle.get(), 1.0);
  nlopt_set_stopval(handle.get(), std::numeric_limits<double>::lowest());
  nlopt_set_maxeval(handle.get(), max_requests(bounded_request.stop));
  const Point step = (initial_step_ * scale).cwiseMin(kLargestStep);
  if (initial_step_ > 0.0) nlopt_set_initial_step(handle.get(), step.data());
  if (is_multistart) {
    const nlopt_algorithm local = uses_gradient ? NLOPT_LD_LBFGS : NLOPT_LN_BOBYQA;
    nlopt_set_local_optimizer(handle.get(), create(local, tolerance).get());
  }
  nlopt_srand(request.seed);  // the generator belongs to this thread

  Point u = unit_box.unit_start();
  double cost = 0.0;
  const nlopt_result code = nlopt_optimize(handle.get(), u.data(), &cost);
  if (tracked.is_stopped()) return tracked.result(SolveStatus::stalled);
  return tracked.result(status_of(code), std::string("NLopt: ") + nlopt_result_to_string(code));
}

SolverFamily nlopt_family() {
  SolverFamily family{
      .label = "nlopt:*",
      .names = {},
      .heeds = SearchParameters::tolerances,
      .make = [](const std::string& name, const Search& search) -> std::unique_ptr<Solver> {
        return std::make_unique<NloptSolver>(name, search.tolerance, search.initial_step);
      }};
  for (const Algorithm& known : kAlgorithms) family.names.emplace_back(known.name);
  return family;
}

}  // namespace nbvopt
