// One search of a strategy.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "best_seen.hpp"
#include "recording_objective.hpp"
#include "strategy.hpp"

namespace nbvopt {

/// The last of the chain of surrogates; the objective itself where it has none.
const Objective& cheapest_surrogate(const Objective& objective);

/// Runs the stages on one objective, once. What its references refer to must outlive it.
class StrategySearch {
 public:
  StrategySearch(const StrategyOptions& options, const StrategyStages& stages,
                 const Objective& objective, const SolveRequest& request);

  SolveResult run();

 private:
  /// A point worth the objective's judgement.
  struct Candidate {
    Point x;
    double value = 0.0;  ///< of a surrogate
    /// Of the local search that ended here.
    SolveStatus status = SolveStatus::converged;
  };

  /// The best separate points that samples and the global solver met on the cheapest surrogate.
  std::vector<Candidate> survey();
  void sample(RecordingObjective& surrogate);
  void search_globally(RecordingObjective& surrogate);

  /// The best separate points that the local solver reached on the first surrogate.
  std::vector<Candidate> climb(const std::vector<Candidate>& starts);

  /// Has the objective evaluate the candidates, the first even where a limit ends the search.
  void judge(const std::vector<Candidate>& candidates);
  void judge(const Point& x);

  std::vector<Candidate> best_separate(const std::vector<Candidate>& candidates) const;

  /// Starts from the best point that the objective has judged.
  void polish();

  /// Takes note of why the search must end now, if it must.
  bool must_end();
  std::int64_t surrogate_evaluations() const;
  /// The evaluations of a stage that plans so many, or its share of a tight limit.
  std::int64_t ration(std::int64_t planned, double share);
  /// With at most `max_evaluations`, and no more than the search has left.
  SolveRequest stage_request(const Point& start, std::int64_t max_evaluations) const;
  void note_stage(std::int64_t evaluations, const std::string& what);
  SolveStatus status() const;
  SolveResult result() const;

  const StrategyOptions& options_;
  const StrategyStages& stages_;
  const SolveRequest& request_;
  RecordingObjective objective_;
  std::deque<RecordingObjective> surrogates_;  ///< the first and, unless the same, the cheapest
  BestSeen best_;
  std::int64_t reserved_evaluations_ = 0;  ///< kept for the best point of the surrogates
  bool is_rationed_ = false;               ///< a stage had to plan for less
  std::optional<SolveStatus> limit_;       ///< what ended the search early
  SolveStatus local_status_ = SolveStatus::converged;  ///< of the search that led to best_
  SolveStatus polish_status_ = SolveStatus::converged;
  std::string stages_note_;
};

}  // namespace nbvopt
