// Strategies: global on a surrogate, local on the same, a short polish on the objective itself.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "nbvopt/solver/solver.hpp"

namespace nbvopt {

/// The stages of a strategy, each a solver of the registry, and what bounds them. A solver left
/// empty leaves its stage out. The defaults are the solver "auto".
struct StrategyOptions {
  std::string global = "nlopt:direct-l";  ///< on the objective's surrogate
  std::string local = "nlopt:lbfgs";      ///< on the objective's surrogate
  std::string polish = "nlopt:cobyla";    ///< on the objective

  /// Points sampled inside each line along coordinate 0 from face to face, through corners and
  /// through centres of edges, faces and box; these are sampled as well.
  int line_points = 15;
  std::int64_t global_evaluations = 20;

  int local_starts = 12;
  /// Local starts are this far apart or farther: a share of the box's width in some coordinate.
  double start_separation = 0.05;
  double local_tolerance = 0.5;         ///< as Search::tolerance
  std::int64_t local_evaluations = 60;  ///< of each start

  /// The most local optima that the objective judges; the polish starts from the best. Fewer where
  /// by the errors of the surrogate on those judged the others cannot be the best.
  int polish_candidates = 12;
  double polish_tolerance = 0.02;  ///< as Search::tolerance
  double polish_step = 1.0;        ///< as Search::initial_step
  std::int64_t polish_evaluations = 60;

  bool operator==(const StrategyOptions&) const = default;
};

/// Stages as users name them: each a solver of the registry, or "none", which leaves it out. Those
/// without a name are those of "auto"; the result is none when no stage is named. Throws UsageError
/// for an empty name.
std::optional<StrategyOptions> named_stages(const std::optional<std::string>& global,
                                            const std::optional<std::string>& local,
                                            const std::optional<std::string>& polish);

/// The way back: the solver of a stage, or "none" where it is left out.
std::string stage_name(const std::string& stage);

/// A solver that searches on the objective's surrogate and answers with what the objective itself
/// evaluated. Without a global and a local stage it needs no surrogate.
///
/// The evaluation limit bounds those of the objective and of its surrogate together; one that is
/// too tight for all stages is shared out among them. Without one the stages' own limits hold. One
/// evaluation is kept for the surrogate's best point: when a limit ends the search early, the
/// objective judges that point first. The status is `converged` when the local search that led to
/// the answer and the polish met their tolerances; without both, when the global solver did.
///
/// Throws UsageError: a name that is not known, a solver that cannot work in its stage, an option
/// out of range. Solving throws it where an objective lacks what a stage needs.
std::unique_ptr<Solver> make_strategy(const StrategyOptions& options);

}  // namespace nbvopt
