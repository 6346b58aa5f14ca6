#include "study/report/plots.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/number.hpp"
#include "plot/line_chart.hpp"
#include "plot/style.hpp"
#include "report/text_table.hpp"
#include "study/evaluate/summary.hpp"
#include "study/report/lines.hpp"

namespace nbvopt {
namespace {

using study::Evaluation;
using study::Results;
using Points = std::vector<Eigen::Vector2d>;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kPixelsPerPoint = 2.0;
constexpr double kLeft = 84.0;
constexpr double kTop = 104.0;
constexpr double kPanelWidth = 390.0;
constexpr double kPanelHeight = 330.0;
constexpr double kBetween = 86.0;  ///< with the right panel's axis
constexpr double kLegendGap = 26.0;
constexpr double kBottom = 56.0;

/// What one panel shows: a line a solver, in the order of the study.
struct Panel {
  std::string heading;
  ChartAxis x_axis;
  ChartAxis y_axis;
  std::vector<Points> lines;
  std::size_t marks_every = 1;
};

/// Panels side by side with one legend at their right.
std::string page(const std::string& title, const std::string& subtitle, const Results& results,
                 const std::vector<double>& score, const std::vector<Panel>& panels) {
  const StudyLines lines(results.solvers, score);
  const double count = static_cast<double>(panels.size());
  const double panels_right = kLeft + count * kPanelWidth + (count - 1.0) * kBetween;
  Canvas canvas(panels_right + kLegendGap + lines.legend_width() + 16.0,
                kTop + kPanelHeight + kBottom, kPixelsPerPoint);
  canvas.text({24.0, 38.0}, title, style::title());
  canvas.text({24.0, 60.0}, subtitle, style::note());
  double x = kLeft;
  for (const Panel& panel : panels) {
    std::vector<ChartLine> drawn;
    for (const std::size_t solver : lines.drawing_order()) {
      // Marks of different lines at different places, so that they do not hide each other.
      const std::size_t first = panel.marks_every == 1 ? 0 : 5 * solver % panel.marks_every;
      drawn.push_back({panel.lines[solver], lines.style(solver), panel.marks_every, first});
    }
    canvas.text({x, kTop - 14.0}, panel.heading, style::heading());
    draw_line_chart(canvas, {x, kTop, kPanelWidth, kPanelHeight}, panel.x_axis, panel.y_axis,
                    drawn);
    x += kPanelWidth + kBetween;
  }
  lines.draw_legend(canvas, {panels_right + kLegendGap, kTop});
  return canvas.png();
}

std::vector<Tick> percent_ticks() {
  std::vector<Tick> ticks;
  for (int percent = 0; percent <= 100; percent += 20) {
    ticks.push_back({percent / 100.0, std::to_string(percent) + " %"});
  }
  return ticks;
}

ChartAxis share_axis(const std::string& title) {
  return {
      .min = 0.0, .max = 1.0, .is_logarithmic = false, .ticks = percent_ticks(), .title = title};
}

ChartAxis log_axis(double min, double max, const std::string& title) {
  return {.min = min,
          .max = max,
          .is_logarithmic = true,
          .ticks = make_log_ticks(min, max),
          .title = title};
}

using Unit = study::Profile study::SolverProfiles::*;

/// The profiles of all solvers in one unit, drawn between two costs.
Panel profile_panel(const std::vector<study::SolverProfiles>& profiles, Unit unit,
                    const ChartAxis& x_axis, const std::string& share) {
  constexpr int kSamples = 240;
  Panel panel{
      .heading = {}, .x_axis = x_axis, .y_axis = share_axis(share), .lines = {}, .marks_every = 48};
  for (const study::SolverProfiles& own : profiles) {
    Points line;
    for (int i = 0; i <= kSamples; ++i) {
      const double cost = x_axis.min * std::pow(x_axis.max / x_axis.min, i / double{kSamples});
      line.emplace_back(cost, (own.*unit).share_within(cost));
    }
    panel.lines.push_back(line);
  }
  return panel;
}

/// How high a solver's lines run, on average over the panels.
std::vector<double> mean_heights(const std::vector<Panel>& panels) {
  std::vector<double> heights;
  for (std::size_t solver = 0; solver < panels.front().lines.size(); ++solver) {
    std::vector<double> all;
    for (const Panel& panel : panels) {
      for (const Eigen::Vector2d& point : panel.lines[solver]) {
        if (!std::isnan(point.y())) all.push_back(point.y());
      }
    }
    heights.push_back(study::mean(all));
  }
  return heights;
}

/// Of all solvers, at least a decade apart.
std::array<double, 2> decades(const std::vector<study::SolverProfiles>& profiles, Unit unit) {
  const auto [least, most] = study::cost_range(profiles, unit);
  return {least, std::max(most, 10.0 * least)};
}

ChartAxis tau_axis(const std::vector<study::SolverProfiles>& profiles, Unit unit) {
  constexpr double kMost = 1000.0;
  return log_axis(1.0, std::min(decades(profiles, unit)[1], kMost),
                  "cost over that of the cheapest solver");
}

/// Equally spaced names along an axis.
ChartAxis name_axis(const std::vector<std::string>& names, const std::string& title) {
  ChartAxis axis{.min = -0.3,
                 .max = static_cast<double>(names.size()) - 0.7,
                 .is_logarithmic = false,
                 .ticks = {},
                 .title = title};
  for (std::size_t i = 0; i < names.size(); ++i) {
    axis.ticks.push_back({static_cast<double>(i), names[i]});
  }
  return axis;
}

/// No picture tells ratios apart that come nearer to 1.
constexpr double kLeastMissed = 1e-4;

/// NaN stays NaN.
double missed(double ratio) { return std::max(1.0 - ratio, kLeastMissed); }

/// What is missed of the best gain, on a logarithmic axis that grows downwards, since good solvers
/// differ in the last tenth of a percent.
ChartAxis missed_axis(const std::vector<study::Summary>& rows) {
  constexpr double kRoom = 1.25;
  double most = kLeastMissed;
  double least = 0.1;
  for (const study::Summary& row : rows) {
    if (std::isnan(row.mean_ratio)) continue;
    most = std::max(most, missed(row.mean_ratio));
    least = std::min(least, missed(row.mean_ratio));
  }
  ChartAxis axis{.min = std::min(1.0, kRoom * std::max(most, 2.0 * least)),
                 .max = std::max(kLeastMissed, least / kRoom),
                 .is_logarithmic = true,
                 .ticks = {},
                 .title = "mean share of the best gain"};
  for (double decade = 1.0; decade >= kLeastMissed; decade /= 10.0) {
    for (const double value : {decade, 0.5 * decade, 0.2 * decade}) {
      if (value > axis.min || value < axis.max) continue;
      const double percent = std::round(1e6 * (1.0 - value)) / 1e4;
      axis.ticks.push_back({value, format_number(percent) + " %"});
    }
  }
  return axis;
}

std::string short_label(const study::Budget& budget) {
  std::string label;
  if (budget.max_evaluations > 0) label = grouped(static_cast<double>(budget.max_evaluations));
  if (budget.time_limit_ms > 0.0) {
    label += (label.empty() ? "" : ", ") + format_number(budget.time_limit_ms) + " ms";
  }
  return label.empty() ? "no limit" : label;
}

}  // namespace

std::string performance_profile_plot(const Results& results, const Evaluation& evaluation) {
  using study::SolverProfiles;
  const auto& profiles = evaluation.performance;
  const std::string share = "share of cases solved";
  std::vector<Panel> panels{profile_panel(profiles, &SolverProfiles::evaluations,
                                          tau_axis(profiles, &SolverProfiles::evaluations), share),
                            profile_panel(profiles, &SolverProfiles::time_ms,
                                          tau_axis(profiles, &SolverProfiles::time_ms), share)};
  panels[0].heading = "Cost in evaluations";
  panels[1].heading = "Cost in milliseconds";
  return page("Performance profile",
              "Cases in which a solver reaches " + decimal(100.0 * study::kProfileTarget, 0) +
                  " % of the best gain at so many times the least cost (Dolan and Mor\u00E9)",
              results, mean_heights(panels), panels);
}

std::string data_profile_plot(const Results& results, const Evaluation& evaluation) {
  using study::SolverProfiles;
  const auto& profiles = evaluation.data;
  const auto evaluations = decades(profiles, &SolverProfiles::evaluations);
  const auto times_ms = decades(profiles, &SolverProfiles::time_ms);
  const std::string share = "share of runs and targets";
  std::vector<Panel> panels{
      profile_panel(profiles, &SolverProfiles::evaluations,
                    log_axis(evaluations[0], evaluations[1], "evaluations, exact and surrogate"),
                    share),
      profile_panel(profiles, &SolverProfiles::time_ms,
                    log_axis(times_ms[0], times_ms[1], "time (ms)"), share)};
  panels[0].heading = "Cost in evaluations";
  panels[1].heading = "Cost in milliseconds";
  return page("Runtime distribution",
              "Pairs of a run and a target, 70 to 99.9 % of the best gain, that are reached within "
              "a cost (COCO)",
              results, mean_heights(panels), panels);
}

std::string budget_plot(const Results& results, const Evaluation& evaluation) {
  std::vector<std::string> names;
  for (const study::Budget& budget : results.budgets) names.push_back(short_label(budget));
  Panel panel{.heading = "All budgets",
              .x_axis = name_axis(names, "budget: evaluations, exact and surrogate, or time"),
              .y_axis = missed_axis(evaluation.summaries),
              .lines = std::vector<Points>(results.solvers.size()),
              .marks_every = 1};
  std::vector<double> score(results.solvers.size(), kNaN);
  for (const study::Summary& row : evaluation.summaries) {
    Points& line = panel.lines[row.solver];
    const bool is_other_kind =
        row.budget > 0 && (results.budgets[row.budget].time_limit_ms > 0.0) !=
                              (results.budgets[row.budget - 1].time_limit_ms > 0.0);
    if (is_other_kind) line.emplace_back(kNaN, kNaN);
    line.emplace_back(static_cast<double>(row.budget), missed(row.mean_ratio));
    if (row.budget == evaluation.budget) score[row.solver] = row.mean_ratio;
  }
  return page("Gain against budget", "Mean over all runs of the exact gain over the best known",
              results, score, {panel});
}

std::string cycle_plot(const Results& results, const Evaluation& evaluation) {
  std::vector<std::string> names;
  for (const study::Cycle& row : evaluation.cycles) {
    if (row.solver == 0)
      names.push_back(row.motion_time_s > 0.0 ? format_number(row.motion_time_s) : "no limit");
  }
  const auto make_panel = [&](const std::string& heading, double study::Cycle::*figure) {
    double most = 0.0;
    for (const study::Cycle& row : evaluation.cycles) {
      if (std::isfinite(row.*figure)) most = std::max(most, row.*figure);
    }
    if (most == 0.0) most = 1.0;
    Panel panel{.heading = heading,
                .x_axis = name_axis(names, "motion time (s)"),
                .y_axis = {.min = 0.0,
                           .max = 1.04 * most,
                           .is_logarithmic = false,
                           .ticks = labelled(make_ticks(0.0, 1.04 * most, 6)),
                           .title = "gain a second"},
                .lines = std::vector<Points>(results.solvers.size()),
                .marks_every = 1};
    for (const study::Cycle& row : evaluation.cycles) {
      Points& line = panel.lines[row.solver];
      line.emplace_back(static_cast<double>(line.size()), row.*figure);
    }
    return panel;
  };
  const std::vector<Panel> panels{
      make_panel("By computing and the answer's motion", &study::Cycle::gain_per_s_moving),
      make_panel("More than staying, by the whole motion time",
                 &study::Cycle::added_per_s_waiting)};
  return page("Gain a second",
              "Exact gain of all runs with the loosest budget over the time of all", results,
              mean_heights(panels), panels);
}

}  // namespace nbvopt
