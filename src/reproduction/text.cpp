#include "reproduction/text.hpp"

#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "core/atomic_file.hpp"
#include "core/number.hpp"
#include "report/text_table.hpp"

namespace nbvopt {
namespace {

using Figure = std::optional<double>;

/// How people read a figure.
enum class Style { whole, percent, ratio };

/// One figure of every row.
template <class Row>
struct Column {
  const char* key;
  const char* heading;  ///< none: for machines only
  Style style;
  Figure (*figure)(const Row&);
};

template <auto member>
Figure own(const ResultRow& row) {
  return row.*member;
}

template <auto member>
Figure paper(const ResultRow& row) {
  if (row.paper == nullptr) return std::nullopt;
  return static_cast<double>(row.paper->*member);
}

/// The paper leaves the cells of the 2D test empty that would compare it with itself.
template <auto member>
Figure paper_change(const ResultRow& row) {
  if (row.test == "2D") return std::nullopt;
  return paper<member>(row);
}

Figure finite(double value) { return std::isfinite(value) ? Figure(value) : std::nullopt; }

constexpr Column<ResultRow> kResultColumns[] = {
    {"starts", "starts", Style::whole, own<&ResultRow::starts>},
    {"voxels", "voxels", Style::whole, own<&ResultRow::voxels>},
    {"voxels_percent", "voxels %", Style::percent, own<&ResultRow::voxels_percent>},
    {"information", "info", Style::whole, own<&ResultRow::information>},
    {"gain", "gain", Style::whole, own<&ResultRow::gain>},
    {"gain_percent", "gain %", Style::percent, own<&ResultRow::gain_percent>},
    {"duration_s", "duration (s)", Style::whole, own<&ResultRow::duration_s>},
    {"voxels_per_s", "voxels/s", Style::whole, own<&ResultRow::voxels_per_s>},
    {"information_per_s", "info/s", Style::whole, own<&ResultRow::information_per_s>},
    {"mean_information", "mean info", Style::whole, own<&ResultRow::mean_information>},
    {"time_to_50_percent_s", "to 50 % (s)", Style::whole, own<&ResultRow::time_to_50_percent_s>},
    {"time_to_80_percent_s", "to 80 % (s)", Style::whole, own<&ResultRow::time_to_80_percent_s>},
    {"time_to_90_percent_s", "to 90 % (s)", Style::whole, own<&ResultRow::time_to_90_percent_s>},
    {"regret_percent", "regret", Style::percent, own<&ResultRow::regret_percent>},
    {"as_paper_counts_voxels_percent", "voxels % `as_paper_counts`", Style::percent,
     own<&ResultRow::as_paper_counts_voxels_percent>},
    {"as_paper_counts_gain_percent", "gain % `as_paper_counts`", Style::percent,
     own<&ResultRow::as_paper_counts_gain_percent>},
    {"paper_voxels", nullptr, Style::whole, paper<&PaperFigures::voxels>},
    {"paper_voxels_percent", "paper: voxels %", Style::percent,
     paper_change<&PaperFigures::voxels_percent>},
    {"paper_information", nullptr, Style::whole, paper<&PaperFigures::information>},
    {"paper_gain", nullptr, Style::whole, paper_change<&PaperFigures::gain>},
    {"paper_gain_percent", "paper: gain %", Style::percent,
     paper_change<&PaperFigures::gain_percent>},
    {"paper_duration_s", "paper: duration (s)", Style::whole, paper<&PaperFigures::duration_s>},
    {"paper_time_percent", nullptr, Style::percent, paper_change<&PaperFigures::time_percent>},
    {"paper_voxels_per_s", nullptr, Style::whole, paper<&PaperFigures::voxels_per_s>},
    {"paper_information_per_s", "paper: info/s", Style::whole,
     paper<&PaperFigures::information_per_s>},
};

constexpr Column<PredictionRow> kPredictionColumns[] = {
    {"steps", "steps", Style::whole,
     [](const PredictionRow& row) { return Figure(row.record.steps); }},
    {"predicted_sum", nullptr, Style::whole,
     [](const PredictionRow& row) { return Figure(row.record.sum_x); }},
    {"realised_sum", nullptr, Style::whole,
     [](const PredictionRow& row) { return Figure(row.record.sum_y); }},
    {"correlation", "correlation", Style::ratio,
     [](const PredictionRow& row) { return finite(row.record.correlation()); }},
    {"bias_percent", "bias", Style::percent,
     [](const PredictionRow& row) { return finite(100.0 * row.record.bias()); }},
};

std::string rounded(double value, Style style) {
  switch (style) {
    case Style::whole:
      return grouped(value);
    case Style::percent:
      return decimal(value, 2) + "%";
    case Style::ratio:
      return decimal(value, 3);
  }
  return {};
}

std::string test_label(const RowLabel& label) {
  if (!label.motion_time_s) return label.test;
  return label.test + " (t=" + decimal(*label.motion_time_s, 1) + ")";
}

std::string own_remark(const ResultRow& row) { return row.remark; }
std::string own_remark(const PredictionRow&) { return {}; }

/// A remark stands where the first figure would.
template <class Row>
std::string markdown_row(const Row& row, std::span<const Column<Row>> columns) {
  std::string text;
  std::string remark = own_remark(row);
  for (const Column<Row>& column : columns) {
    if (column.heading == nullptr) continue;
    const Figure figure = column.figure(row);
    text += ' ' + (figure ? rounded(*figure, column.style) : std::exchange(remark, "")) + " |";
  }
  return text;
}

/// An environment's name stands on its first row only, as in the paper.
template <class Row>
std::string markdown(const std::vector<Row>& rows, std::span<const Column<Row>> columns) {
  std::string head = "| environment | test type |";
  std::string rule = "| --- | --- |";
  for (const Column<Row>& column : columns) {
    if (column.heading == nullptr) continue;
    head += ' ' + std::string(column.heading) + " |";
    rule += " ---: |";
  }
  std::string text = head + '\n' + rule + '\n';
  std::string environment;
  for (const Row& row : rows) {
    text += "| " + (row.environment == environment ? "" : row.environment) + " | " +
            test_label(row) + " |" + markdown_row(row, columns) + '\n';
    environment = row.environment;
  }
  return text;
}

template <class Row>
std::string csv(const std::vector<Row>& rows, std::span<const Column<Row>> columns) {
  std::string text = "environment,test,motion_time_s";
  for (const Column<Row>& column : columns) text += ',' + std::string(column.key);
  text += '\n';
  for (const Row& row : rows) {
    text += row.environment + ',' + row.test + ',' +
            (row.motion_time_s ? format_number(*row.motion_time_s) : "");
    for (const Column<Row>& column : columns) {
      const Figure figure = column.figure(row);
      text += ',' + (figure ? format_number(*figure) : "");
    }
    text += '\n';
  }
  return text;
}

Json figure_json(const Figure& figure) { return figure ? Json(*figure) : Json(nullptr); }

template <class Row>
Json json(const std::vector<Row>& rows, std::span<const Column<Row>> columns) {
  Json all = Json::array();
  for (const Row& row : rows) {
    Json object{{"environment", row.environment},
                {"test", row.test},
                {"motion_time_s", figure_json(row.motion_time_s)}};
    for (const Column<Row>& column : columns) object[column.key] = figure_json(column.figure(row));
    if (const std::string remark = own_remark(row); !remark.empty()) object["remark"] = remark;
    all.push_back(std::move(object));
  }
  return all;
}

std::string list_note(const char* what, const std::vector<std::string>& names) {
  if (names.empty()) return {};
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return std::string("\n") + what + text + ".\n";
}

constexpr const char* kResultNotes = R"(
Figures are means over the starts. Every mode captures a frame each t, so each t has a still camera
(2D) of its own, which the rows of that t below it are compared with; of a start that lacks one of
both, the percentages know nothing. `grid` is the paper's search (pan only, 0.8 rad) and stands
beside its 2D+optimisation, `grid-3` is that search over three joints; `auto` and `random` have no
counterpart in the paper. 3D is another exploration with a still camera: it drives as long as the
paper's did and is compared with 2D from the same start at the same t; 3D tekniker is the same as
the paper's authors changed and ran it. Voxels are occupied ones
with u < 1 at the finest resolution, info is Eq. 11 over them; `as_paper_counts` counts as the
authors' code does, inner nodes of the tree included. `auto` seeks the paper's gain, `auto expected`
the expected one. `oracle` cheats: it takes the best of 100 random views by what they truly bring at
the base's next pose; the regret is what is missing to it at the same t. Mean info is the area below
information over time by the duration, and "to 50 %" when the map knew half of what the best of all
modes and t knew in the end on that drive; where a start never came so far, the cell is empty. Compare percentages with the paper's, never
absolutes: geometry has no textures here, localisation is perfect and the exploration is our own.
)";

constexpr const char* kPredictionNotes = R"(
The gain that a step's search predicted against the gain that its next capture realised, over all
steps of all starts; the bias is how much more was predicted than came. Realised is what the same
48 x 36 rays bring by Eq. 12 where the base has driven meanwhile, with the surfaces that are there:
the search took the base to stand and all that is unknown to be occupied; `auto expected` takes
neither for granted.
)";

}  // namespace

std::string to_markdown(const ReproductionTable& table) {
  return "# The paper's experiment, reproduced\n\n" +
         markdown<ResultRow>(table.results, kResultColumns) + kResultNotes +
         list_note("Missing, since they did not run to their end: ", table.missing) +
         list_note("Not explored to the end, for lack of time: ", table.incomplete) +
         "\n## Gain predicted and realised\n\n" +
         markdown<PredictionRow>(table.predictions, kPredictionColumns) + kPredictionNotes;
}

std::string to_csv(const std::vector<ResultRow>& rows) {
  return csv<ResultRow>(rows, kResultColumns);
}

std::string to_csv(const std::vector<PredictionRow>& rows) {
  return csv<PredictionRow>(rows, kPredictionColumns);
}

Json to_json(const ReproductionTable& table) {
  return {{"results", json<ResultRow>(table.results, kResultColumns)},
          {"predictions", json<PredictionRow>(table.predictions, kPredictionColumns)},
          {"missing", table.missing},
          {"incomplete_explorations", table.incomplete}};
}

void write_tables(const ReproductionTable& table, const std::filesystem::path& folder) {
  write_file_atomically(folder / "table.md", to_markdown(table));
  write_file_atomically(folder / "table.csv", to_csv(table.results));
  write_file_atomically(folder / "prediction.csv", to_csv(table.predictions));
  write_file_atomically(folder / "table.json", to_text(to_json(table)));
}

}  // namespace nbvopt
