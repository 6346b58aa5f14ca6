#include "solvers/strategy/strategy_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solvers/answer.hpp"
#include "solvers/batch_search.hpp"
#include "solvers/strategy/objectives.hpp"
#include "solvers/strategy/points.hpp"

namespace nbvopt {
namespace {

/// Ends of local searches nearer than this share of the box's width are one optimum.
constexpr double kSameOptimum = 0.01;

/// Until so many were judged, little is known of the surrogate's error.
constexpr std::size_t kFewestJudged = 3;

/// What each stage may spend of an evaluation limit that is too tight for all; the polish has the
/// rest.
constexpr std::int64_t kFewestSamples = 12;
constexpr double kSampleShare = 1.0 / 3.0;
constexpr double kGlobalShare = 1.0 / 4.0;
constexpr double kLocalShare = 1.0 / 4.0;

}  // namespace

StrategySearch::StrategySearch(const StrategyOptions& options, const StrategyStages& stages,
                               const Objective& objective, const SolveRequest& request)
    : options_(options),
      stages_(stages),
      request_(request),
      objective_(objective),
      best_(objective) {
  if (!stages.global && !stages.local) return;
  reserved_evaluations_ = 1;
  surrogate_.emplace(*objective.surrogate());
}

SolveResult StrategySearch::run() {
  best_.offer(request_.start, objective_.value(request_.start));
  if (objective_.box().lower == objective_.box().upper) return result();
  judge(climb(survey()));
  polish();
  return result();
}

std::vector<StrategySearch::Candidate> StrategySearch::survey() {
  if (!surrogate_ || must_end()) return {};
  sample();
  SolveStatus status = SolveStatus::converged;
  if (stages_.global && !must_end()) status = search_globally();

  std::vector<Candidate> starts;
  for (const std::size_t i : separate_points(*surrogate_, surrogate_->points(),
                                             surrogate_->values(), options_.start_separation,
                                             static_cast<std::size_t>(options_.local_starts))) {
    starts.push_back(
        {surrogate_->points().col(static_cast<Eigen::Index>(i)), surrogate_->values()[i], status});
  }
  return starts;
}

void StrategySearch::sample() {
  const std::vector<Point> points = start_points(*surrogate_, options_.line_points);
  auto next = points.begin() + 1;  // a search evaluates its start first
  const auto next_candidate = [&]() -> std::optional<Point> {
    if (next == points.end()) return std::nullopt;
    return *next++;
  };
  const std::int64_t limit =
      std::max(kFewestSamples, ration(static_cast<std::int64_t>(points.size()), kSampleShare));
  batch_search(*surrogate_, stage_request(points.front(), limit), next_candidate,
               SolveStatus::grid_complete);
  note_stage(surrogate_->evaluations(), "samples");
}

SolveStatus StrategySearch::search_globally() {
  const std::int64_t before = surrogate_->evaluations();
  const auto best =
      separate_points(*surrogate_, surrogate_->points(), surrogate_->values(), 0.0, 1);
  const Point start =
      best.empty() ? request_.start : surrogate_->points().col(static_cast<Eigen::Index>(best[0]));
  const SolveResult end = stages_.global->solve(
      *surrogate_, stage_request(start, ration(options_.global_evaluations, kGlobalShare)));
  note_stage(surrogate_->evaluations() - before, "of global " + stages_.global->name());
  return end.status;
}

std::vector<StrategySearch::Candidate> StrategySearch::climb(const std::vector<Candidate>& starts) {
  std::vector<Candidate> ends;
  if (stages_.local && !starts.empty()) {
    const std::int64_t before = surrogate_->evaluations();
    const std::int64_t limit =
        ration(options_.local_evaluations * static_cast<std::int64_t>(starts.size()), kLocalShare);
    for (const Candidate& start : starts) {
      const std::int64_t left = limit - (surrogate_->evaluations() - before);
      if (must_end() || left < 1) break;
      ends.push_back(climb(start, std::min(left, options_.local_evaluations)));
    }
    note_stage(surrogate_->evaluations() - before, "of local " + stages_.local->name() + " from " +
                                                       std::to_string(ends.size()) +
                                                       (ends.size() == 1 ? " start" : " starts"));
  }
  return best_separate(ends.empty() ? starts : ends);
}

StrategySearch::Candidate StrategySearch::climb(const Candidate& start,
                                                std::int64_t max_evaluations) {
  const std::int64_t last = surrogate_->evaluations() + max_evaluations;
  Candidate end = start;
  end.status = SolveStatus::stalled;
  while (end.status == SolveStatus::stalled && surrogate_->evaluations() < last && !must_end()) {
    const ShiftedPeriod shifted(*surrogate_, end.x);
    const SolveResult found =
        stages_.local->solve(shifted, stage_request(end.x, last - surrogate_->evaluations()));
    const bool is_higher = found.value > end.value;
    end.status =
        found.status == SolveStatus::stalled && !is_higher ? SolveStatus::converged : found.status;
    if (is_higher) end = {shifted.wrapped(found.best), found.value, end.status};
  }
  return end;
}

void StrategySearch::judge(const std::vector<Candidate>& candidates) {
  must_end();  // the last local search may have been cut short
  reserved_evaluations_ = 0;
  double error = 0.0;
  std::size_t judged = 0;
  for (const Candidate& candidate : candidates) {
    if (judged > 0 && must_end()) break;
    if (judged >= kFewestJudged && candidate.value + error < best_.value()) break;
    const double value = objective_.value(candidate.x);
    best_.offer(candidate.x, value);
    if (judged == 0 || best_.point() == candidate.x) search_status_ = candidate.status;
    error = std::max(error, std::abs(value - candidate.value));
    ++judged;
  }
}

void StrategySearch::polish() {
  if (!stages_.polish || must_end()) return;
  const std::int64_t before = objective_.evaluations();
  const ShiftedPeriod shifted(objective_, best_.point());
  const SolveResult end =
      stages_.polish->solve(shifted, stage_request(best_.point(), options_.polish_evaluations));
  best_.offer(shifted.wrapped(end.best), end.value);
  polish_status_ = end.status;
  note_stage(objective_.evaluations() - before, "of polish " + stages_.polish->name());
}

std::vector<StrategySearch::Candidate> StrategySearch::best_separate(
    const std::vector<Candidate>& candidates) const {
  Eigen::MatrixXd points(objective_.box().dimension(), candidates.size());
  std::vector<double> values;
  for (const Candidate& candidate : candidates) {
    points.col(static_cast<Eigen::Index>(values.size())) = candidate.x;
    values.push_back(candidate.value);
  }
  std::vector<Candidate> best;
  for (const std::size_t i :
       separate_points(objective_, points, values, kSameOptimum,
                       static_cast<std::size_t>(options_.polish_candidates))) {
    best.push_back(candidates[i]);
  }
  return best;
}

bool StrategySearch::must_end() {
  if (!limit_) {
    limit_ = stop_status(
        request_.stop, objective_.evaluations() + surrogate_evaluations() + reserved_evaluations_);
  }
  return limit_.has_value();
}

std::int64_t StrategySearch::surrogate_evaluations() const {
  return surrogate_ ? surrogate_->evaluations() : 0;
}

std::int64_t StrategySearch::ration(std::int64_t planned, double share) {
  const double limit = share * static_cast<double>(request_.stop.max_evaluations);
  if (limit >= static_cast<double>(planned)) return planned;
  is_rationed_ = true;
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(limit));
}

SolveRequest StrategySearch::stage_request(const Point& start, std::int64_t max_evaluations) const {
  SolveRequest request{start, request_.stop, request_.seed};
  const std::int64_t left = request_.stop.max_evaluations - objective_.evaluations() -
                            surrogate_evaluations() - reserved_evaluations_;
  request.stop.max_evaluations = std::min(left, max_evaluations);
  return request;
}

void StrategySearch::note_stage(std::int64_t evaluations, const std::string& what) {
  stages_note_ += (stages_note_.empty() ? ": " : ", ") + std::to_string(evaluations) + " " + what;
}

SolveStatus StrategySearch::status() const {
  if (limit_) return *limit_;
  if (is_rationed_) return SolveStatus::evaluation_limit;
  if (polish_status_ != SolveStatus::converged) return polish_status_;
  // A polish that follows no local search is one itself.
  if (stages_.polish && !stages_.local) return SolveStatus::converged;
  if (search_status_ != SolveStatus::converged) return SolveStatus::evaluation_limit;
  return SolveStatus::converged;
}

SolveResult StrategySearch::result() const {
  const std::int64_t of_surrogates = surrogate_evaluations();
  std::string message = solve_message(status(), objective_.evaluations());
  if (of_surrogates > 0) message += " and " + std::to_string(of_surrogates) + " of the surrogate";
  return {status(),      message + stages_note_,   best_.point(),
          best_.value(), objective_.evaluations(), of_surrogates};
}

}  // namespace nbvopt
