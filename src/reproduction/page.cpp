#include "reproduction/page.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>
#include <variant>
#include <vector>

#include "core/html_text.hpp"
#include "core/number.hpp"
#include "core/text_file.hpp"
#include "report/html.hpp"
#include "reproduction/growth_chart.hpp"
#include "reproduction/paper_tables.hpp"
#include "reproduction/text.hpp"

namespace nbvopt {
namespace {

constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>The paper's experiment, reproduced</title>
<style>
body { font: 15px/1.5 sans-serif; color: #1f2933; margin: 2em auto; max-width: 76em; padding: 0 1em; }
h1, h2, h3 { line-height: 1.2; }
img { max-width: 100%; }
.maps { display: flex; flex-wrap: wrap; gap: 1em; }
.maps figure { margin: 0; width: 20em; }
.table { overflow-x: auto; }
table { border-collapse: collapse; font-size: 13px; white-space: nowrap; }
th, td { padding: 0.2em 0.6em; border-bottom: 1px solid #e4e7eb; text-align: right; }
.text { text-align: left; }
p { max-width: 52em; }
</style>
</head>
<body>
)";

const EpisodeSetting* episode_setting(const Unit& unit) {
  return std::get_if<EpisodeSetting>(&unit.simulation.setting);
}

/// How tables call an episode.
std::string test_name(const Unit& unit) { return test_name(*episode_setting(unit), unit.explorer); }

/// The names of all tests, in the order in which they come first.
std::vector<std::string> test_names(std::span<const Unit> units) {
  std::vector<std::string> names;
  for (const Unit& unit : units) {
    if (episode_setting(unit) == nullptr) continue;
    if (const std::string name = test_name(unit); std::ranges::find(names, name) == names.end()) {
      names.push_back(name);
    }
  }
  return names;
}

/// How the tests of one t did in an environment; empty where none did.
std::string growth(const ExperimentEnvironment& environment, double motion_time_s,
                   std::span<const Unit> units, std::span<const UnitResult> results) {
  const std::vector<std::string> names = test_names(units);
  std::vector<GrowthSeries> series;
  for (std::size_t line = 0; line < names.size(); ++line) {
    GrowthSeries own{names[line], line, {}};
    for (std::size_t i = 0; i < units.size(); ++i) {
      if (units[i].environment != &environment || !results[i].episode ||
          episode_setting(units[i])->motion_time_s != motion_time_s ||
          test_name(units[i]) != own.label) {
        continue;
      }
      own.growths.push_back(&results[i].episode->summary.growth);
    }
    if (!own.growths.empty()) series.push_back(std::move(own));
  }
  if (series.empty()) return {};
  const std::string title =
      std::string(environment.paper_name) + ", t = " + format_number(motion_time_s) + " s";
  return "<p>" + html_image(growth_chart_png(title, series), "Information over time: " + title) +
         "</p>\n";
}

/// The maps of an environment that its episodes have drawn.
std::string maps(const ExperimentEnvironment& environment, std::span<const Unit> units) {
  std::string figures;
  for (const Unit& unit : units) {
    const EpisodeSetting* setting = episode_setting(unit);
    const std::filesystem::path& picture = unit.simulation.picture;
    if (unit.environment != &environment || setting == nullptr || picture.empty() ||
        !std::filesystem::exists(picture)) {
      continue;
    }
    const std::string label = test_name(unit) + ", t = " + format_number(setting->motion_time_s) +
                              " s, start " + std::to_string(unit.start);
    figures += "<figure>" + html_image(read_text_file(picture), "The map by " + label) +
               "<figcaption>" + html_escaped(label) + "</figcaption></figure>\n";
  }
  return figures.empty() ? "" : "<div class=\"maps\">\n" + figures + "</div>\n";
}

std::string table_section(const TextTable& table, const char* notes) {
  std::string text;
  for (const char* letter = notes; *letter != '\0'; ++letter) {
    if (*letter != '`') text += *letter;  // Markdown's
  }
  return "<div class=\"table\">\n" + to_html(table) + "</div>\n<p>" + html_escaped(text) + "</p>\n";
}

}  // namespace

std::string to_html(const ReproductionTable& table, std::span<const Unit> units,
                    std::span<const UnitResult> results) {
  std::string html = std::string(kHead) + "<h1>The paper's experiment, reproduced</h1>\n";
  for (const std::string& note : hole_notes(table)) html += "<p>" + html_escaped(note) + "</p>\n";
  html +=
      "<h2>Information over time</h2>\n<p>Lines are means over the drives, bands reach from the "
      "least to the most of them.</p>\n";
  for (const ExperimentEnvironment& environment : experiment_environments()) {
    std::string section;
    for (const double motion_time_s : kPaperMotionTimes_s) {
      section += growth(environment, motion_time_s, units, results);
    }
    section += maps(environment, units);
    if (section.empty()) continue;
    html += "<h3>" + html_escaped(environment.paper_name) + "</h3>\n" + section;
  }
  html += "<h2>All figures</h2>\n" + table_section(result_table(table), kResultNotes);
  if (!table.comparisons.empty()) {
    html += "<h2>Tests compared</h2>\n" + table_section(comparison_table(table), kComparisonNotes);
  }
  return html + "<h2>Gain predicted and realised</h2>\n" +
         table_section(prediction_table(table), kPredictionNotes) + "</body>\n</html>\n";
}

}  // namespace nbvopt
