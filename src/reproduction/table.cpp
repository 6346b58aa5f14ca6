#include "reproduction/table.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <variant>

#include "core/json.hpp"

namespace nbvopt {
namespace {

/// Where a drive begins, and its seed.
using Origin = std::pair<std::size_t, std::uint64_t>;

/// Episodes of one environment and setting.
using Episodes = std::map<Origin, EpisodeReport>;

Origin origin_of(const Unit& unit) { return {unit.start, unit.simulation.seed}; }

/// A number of an episode.
using FigureOf = double (*)(const EpisodeReport&);

double duration_s(const EpisodeReport& episode) { return episode.summary.duration_s; }
double voxels(const EpisodeReport& episode) { return static_cast<double>(episode.summary.voxels); }
double information(const EpisodeReport& episode) { return episode.summary.information; }
double mean_information(const EpisodeReport& episode) {
  return episode.summary.growth.mean_until(episode.summary.duration_s);
}
double voxels_as_paper_counts(const EpisodeReport& episode) {
  return static_cast<double>(episode.paper_counts.voxels);
}
double information_as_paper_counts(const EpisodeReport& episode) {
  return episode.paper_counts.information;
}

double ghosts(const EpisodeReport& episode) {
  return static_cast<double>(episode.summary.ghosts.value_or(0));
}

/// Every result where it belongs.
class ResultIndex {
 public:
  ResultIndex(std::span<const Unit> units, std::span<const UnitResult> results)
      : units_(units), results_(results) {}

  bool has_environment(const ExperimentEnvironment& environment) const {
    return std::ranges::find(units_, &environment, &Unit::environment) != units_.end();
  }

  /// Whether it is asked for, anywhere.
  bool has_test(const EpisodeSetting& setting, ExplorerKind explorer) const {
    return std::ranges::any_of(units_, [&](const Unit& unit) {
      const auto* episode = std::get_if<EpisodeSetting>(&unit.simulation.setting);
      return unit.explorer == explorer && episode && *episode == setting;
    });
  }

  Episodes episodes(const ExperimentEnvironment& environment, const EpisodeSetting& setting,
                    ExplorerKind explorer = ExplorerKind::plane) const {
    Episodes found;
    for (std::size_t i = 0; i < units_.size(); ++i) {
      const Unit& unit = units_[i];
      const auto* episode = std::get_if<EpisodeSetting>(&unit.simulation.setting);
      if (unit.environment == &environment && unit.explorer == explorer && episode &&
          *episode == setting && results_[i].episode) {
        found.emplace(origin_of(unit), *results_[i].episode);
      }
    }
    return found;
  }

  /// The most that any episode on that drive in the plane has learnt.
  double best_information(const ExperimentEnvironment& environment, const Origin& origin) const {
    double best = 0.0;
    for (std::size_t i = 0; i < units_.size(); ++i) {
      if (units_[i].environment != &environment || origin_of(units_[i]) != origin ||
          units_[i].explorer != ExplorerKind::plane) {
        continue;
      }
      if (results_[i].episode) best = std::max(best, information(*results_[i].episode));
    }
    return best;
  }

 private:
  std::span<const Unit> units_;
  std::span<const UnitResult> results_;
};

template <class Figure>
double mean(const Episodes& episodes, const Figure& figure) {
  double sum = 0.0;
  for (const auto& [origin, episode] : episodes) sum += figure(episode);
  return sum / static_cast<double>(episodes.size());
}

/// Those of the drives that the others have, too.
Episodes shared_with(const Episodes& episodes, const Episodes& others) {
  Episodes shared;
  std::ranges::copy_if(episodes, std::inserter(shared, shared.end()),
                       [&](const auto& episode) { return others.contains(episode.first); });
  return shared;
}

void set_figures(ResultRow& row, const Episodes& episodes) {
  row.drives = static_cast<double>(episodes.size());
  row.voxels = mean(episodes, voxels);
  row.information = mean(episodes, information);
  const auto by_information = [](const auto& a, const auto& b) {
    return information(a.second) < information(b.second);
  };
  const auto [least, most] = std::ranges::minmax_element(episodes, by_information);
  row.information_least = information(least->second);
  row.information_most = information(most->second);
  if (episodes.begin()->second.summary.ghosts) row.ghosts = mean(episodes, ghosts);
  row.mean_information = mean(episodes, mean_information);
  row.duration_s = mean(episodes, duration_s);
  row.voxels_per_s = *row.voxels / *row.duration_s;
  row.information_per_s = *row.information / *row.duration_s;
}

double mean_information_at(double time_s, const Episodes& episodes) {
  return mean(episodes,
              [&](const EpisodeReport& episode) { return episode.summary.growth.at(time_s); });
}

/// The paper's test of that kind takes so long, and its still camera in the plane.
struct PapersDurations {
  double test_s;
  double still_s;
};

void set_comparison(ResultRow& row, const Episodes& all_episodes, const Episodes& all_still,
                    const PapersDurations& papers) {
  const Episodes episodes = shared_with(all_episodes, all_still);
  const Episodes still = shared_with(all_still, all_episodes);
  if (episodes.empty()) return;
  const auto percent = [&](FigureOf figure) {
    return 100.0 * (mean(episodes, figure) / mean(still, figure) - 1.0);
  };
  row.voxels_percent = percent(voxels);
  row.gain = mean(episodes, information) - mean(still, information);
  row.gain_percent = percent(information);
  const double still_then = mean_information_at(papers.still_s, still);
  if (still_then > 0.0) {
    row.gain_percent_in_papers_time =
        100.0 * (mean_information_at(papers.test_s, episodes) / still_then - 1.0);
  }
  row.as_paper_counts_voxels_percent = percent(voxels_as_paper_counts);
  row.as_paper_counts_gain_percent = percent(information_as_paper_counts);
}

/// The mean time until that share of the best map was known.
std::optional<double> time_to_s(double share, const Episodes& episodes,
                                const ExperimentEnvironment& environment,
                                const ResultIndex& index) {
  double sum_s = 0.0;
  for (const auto& [origin, episode] : episodes) {
    const auto time_s =
        episode.summary.growth.time_to_s(share * index.best_information(environment, origin));
    if (!time_s) return std::nullopt;
    sum_s += *time_s;
  }
  return sum_s / static_cast<double>(episodes.size());
}

void set_regret(ResultRow& row, const Episodes& all_episodes, const Episodes& all_oracles) {
  const Episodes oracles = shared_with(all_oracles, all_episodes);
  if (oracles.empty()) return;
  row.regret_percent = 100.0 * (1.0 - mean(shared_with(all_episodes, all_oracles), information) /
                                          mean(oracles, information));
}

/// What the paper's tables say of this test: they know a still camera and the pan grid.
const PaperFigures* paper_figures(const PaperEnvironment& paper, const EpisodeSetting& setting) {
  if (setting.mode == "static") return &paper.planar;
  if (setting.mode != "grid") return nullptr;
  const auto t = std::ranges::find(kPaperMotionTimes_s, setting.motion_time_s);
  return &paper.optimised[static_cast<std::size_t>(t - kPaperMotionTimes_s.begin())];
}

std::string paper_label(const PaperEnvironment& paper) {
  return std::string(paper.name) + " (" + std::string(paper.size_m) + ")";
}

ResultRow paper_row(const PaperEnvironment& paper, std::string test,
                    std::optional<double> motion_time_s, std::string remark,
                    const PaperFigures& figures) {
  ResultRow row;
  row.environment = paper_label(paper);
  row.test = std::move(test);
  row.motion_time_s = motion_time_s;
  row.remark = std::move(remark);
  row.paper = &figures;
  return row;
}

/// The rows of an environment whose world is not there.
void append_paper_rows(std::vector<ResultRow>& rows, const PaperEnvironment& paper,
                       const ExperimentEnvironment& environment, const ResultIndex& index) {
  const std::string remark = "there is no " + std::string(environment.world_file);
  rows.push_back(paper_row(paper, "2D", std::nullopt, remark, paper.planar));
  for (std::size_t i = 0; i < kPaperMotionTimes_s.size(); ++i) {
    if (!index.has_test({"grid", kPaperMotionTimes_s[i]}, ExplorerKind::plane)) continue;
    rows.push_back(paper_row(paper, "2D+grid", kPaperMotionTimes_s[i], remark, paper.optimised[i]));
  }
  const SpatialTest& published = spatial_tests().front();
  if (!index.has_test(published.setting, published.explorer)) return;
  rows.push_back(paper_row(paper, "3D", std::nullopt, remark, paper.spatial));
}

/// Another drive is compared with that in the plane from the same start. The paper's figures stand
/// beside the first of them.
ResultRow spatial_row(const PaperEnvironment& paper, const ExperimentEnvironment& environment,
                      const SpatialTest& test, const ResultIndex& index) {
  ResultRow row;
  row.environment = paper_label(paper);
  row.test = test.name;
  row.motion_time_s = test.setting.motion_time_s;
  if (test.explorer == ExplorerKind::volume) row.paper = &paper.spatial;
  const Episodes episodes = index.episodes(environment, test.setting, test.explorer);
  if (episodes.empty()) {
    row.remark = "missing";
    return row;
  }
  set_figures(row, episodes);
  const double planar_s = paper.planar.duration_s;
  set_comparison(
      row, episodes, index.episodes(environment, kSpatialReference),
      {.test_s = test.is_papers ? paper.spatial.duration_s : planar_s, .still_s = planar_s});
  return row;
}

/// Tests that were left out have no rows.
void append_rows(std::vector<ResultRow>& rows, const PaperEnvironment& paper,
                 const ExperimentEnvironment& environment, const ResultIndex& index) {
  const double planar_s = paper.planar.duration_s;
  for (const EpisodeSetting& setting : episode_settings()) {
    if (!index.has_test(setting, ExplorerKind::plane)) continue;
    ResultRow row;
    row.environment = paper_label(paper);
    row.test = test_name(setting);
    row.motion_time_s = setting.motion_time_s;
    row.paper = paper_figures(paper, setting);
    const Episodes episodes = index.episodes(environment, setting);
    if (episodes.empty()) {
      row.remark = "missing";
    } else {
      set_figures(row, episodes);
      row.time_to_50_percent_s = time_to_s(0.5, episodes, environment, index);
      row.time_to_80_percent_s = time_to_s(0.8, episodes, environment, index);
      row.time_to_90_percent_s = time_to_s(0.9, episodes, environment, index);
      set_regret(row, episodes, index.episodes(environment, {"oracle", setting.motion_time_s}));
      if (setting.mode != "static") {
        set_comparison(row, episodes,
                       index.episodes(environment, {"static", setting.motion_time_s}),
                       {.test_s = planar_s, .still_s = planar_s});
      }
    }
    rows.push_back(std::move(row));
  }
  for (const SpatialTest& test : spatial_tests()) {
    if (!index.has_test(test.setting, test.explorer)) continue;
    rows.push_back(spatial_row(paper, environment, test, index));
  }
}

std::vector<ResultRow> result_rows(const ResultIndex& index,
                                   std::span<const ExperimentEnvironment* const> missing) {
  std::vector<ResultRow> rows;
  for (const PaperEnvironment& paper : paper_tables()) {
    const auto all = experiment_environments();
    const auto environment = std::ranges::find(all, paper.name, &ExperimentEnvironment::paper_name);
    if (std::ranges::find(missing, &*environment) != missing.end()) {
      append_paper_rows(rows, paper, *environment, index);
    } else if (index.has_environment(*environment)) {
      append_rows(rows, paper, *environment, index);
    }
  }
  return rows;
}

/// One row a setting for these environments together; none where nothing was predicted.
void append_predictions(std::vector<PredictionRow>& rows, const std::string& label,
                        std::span<const ExperimentEnvironment> environments,
                        const ResultIndex& index) {
  for (const EpisodeSetting& setting : episode_settings()) {
    PredictionRow row;
    row.environment = label;
    row.test = test_name(setting);
    row.motion_time_s = setting.motion_time_s;
    for (const ExperimentEnvironment& environment : environments) {
      for (const auto& [origin, episode] : index.episodes(environment, setting)) {
        row.record += episode.summary.prediction;
      }
    }
    if (row.record.steps > 0) rows.push_back(std::move(row));
  }
}

std::vector<PredictionRow> prediction_rows(const ResultIndex& index) {
  std::vector<PredictionRow> rows;
  const auto all = experiment_environments();
  append_predictions(rows, "all", all, index);
  for (std::size_t i = 0; i < all.size(); ++i) {
    append_predictions(rows, std::string(all[i].paper_name), all.subspan(i, 1), index);
  }
  return rows;
}

}  // namespace

ReproductionTable make_table(std::span<const Unit> units, std::span<const UnitResult> results,
                             std::span<const ExperimentEnvironment* const> missing) {
  const ResultIndex index(units, results);
  ReproductionTable table{.results = result_rows(index, missing),
                          .comparisons = compare_tests(units, results),
                          .predictions = prediction_rows(index)};
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (!results[i].is_there()) table.missing.push_back(units[i].name);
    if (results[i].drive && !ends_with_papers(units[i].explorer) &&
        results[i].drive->status != ExplorationStatus::complete) {
      table.incomplete.push_back(units[i].name);
    }
  }
  return table;
}

}  // namespace nbvopt
