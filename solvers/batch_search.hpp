// The loop of the solvers that choose their points without looking at values.
#pragma once

#include <functional>
#include <optional>

#include "nbvopt/solver/solver.hpp"

namespace nbvopt {

/// Yields the next point to evaluate; nothing when all are spent.
using CandidateSource = std::function<std::optional<Point>()>;

/// Evaluates the start, then the candidates in their order, in batches that may use all cores.
/// The stop rule is checked between batches, which hold one point a core: a time limit is kept up
/// to one evaluation a thread, the evaluation limit exactly. The points, and so the answer, do not
/// depend on the number of cores. The status is `when_spent` when every candidate was evaluated.
SolveResult batch_search(const Objective& objective, const SolveRequest& request,
                         const CandidateSource& next_candidate, SolveStatus when_spent);

}  // namespace nbvopt
