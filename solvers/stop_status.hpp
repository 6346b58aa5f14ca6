// Why a search must end now, if it must; and how a user is told.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "nbvopt/solver/solver.hpp"

namespace nbvopt {

/// The reason to stop before another evaluation; nothing while the search may go on.
std::optional<SolveStatus> stop_status(const StopRule& stop, std::int64_t evaluations);

/// Evaluations for each coordinate that is not frozen, where the request sets no limit.
inline constexpr std::int64_t kDefaultEvaluations = 200;

/// The request with an evaluation limit, the default one where it has none: every search ends.
SolveRequest bounded(const SolveRequest& request, Eigen::Index free_dimension);

/// One line in plain words.
std::string solve_message(SolveStatus status, std::int64_t evaluations);

}  // namespace nbvopt
