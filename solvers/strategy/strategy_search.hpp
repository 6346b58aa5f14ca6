// One search of a strategy.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "nbvopt/solver/strategy.hpp"
#include "solvers/answer.hpp"
#include "solvers/strategy/objectives.hpp"

namespace nbvopt {

/// The solvers of a strategy's stages; null where a stage is left out.
struct StrategyStages {
  std::unique_ptr<Solver> global;
  std::unique_ptr<Solver> local;
  std::unique_ptr<Solver> polish;
};

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
    double value = 0.0;                         ///< of the surrogate
    SolveStatus status = SolveStatus::not_run;  ///< of the search that found it
  };

  /// The best separate points of the surrogate that samples and the global solver met.
  std::vector<Candidate> survey();
  void sample();
  SolveStatus search_globally();

  /// The best separate points of the surrogate that the local solver reached.
  std::vector<Candidate> climb(const std::vector<Candidate>& starts);

  /// The local search from one start. One that gives up goes on from where it is, with nothing
  /// remembered; where even that finds nothing higher, the end is a summit to its line search.
  Candidate climb(const Candidate& start, std::int64_t max_evaluations);

  /// Has the objective evaluate candidates, best first, as long as one of them may be the best: by
  /// its surrogate and the largest error of the surrogate seen. The first even where a limit ends
  /// the search.
  void judge(const std::vector<Candidate>& candidates);

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
  std::optional<RecordingObjective> surrogate_;  ///< none where only the polish runs
  BestSeen best_;
  std::int64_t reserved_evaluations_ = 0;  ///< kept for the best point of the surrogate
  bool is_rationed_ = false;               ///< a stage had to plan for less
  std::optional<SolveStatus> limit_;       ///< what ended the search early
  /// Of the search on the surrogate that led to best_, or to the first point judged.
  SolveStatus search_status_ = SolveStatus::converged;
  SolveStatus polish_status_ = SolveStatus::converged;
  std::string stages_note_;
};

}  // namespace nbvopt
