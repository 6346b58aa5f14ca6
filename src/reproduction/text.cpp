#include "reproduction/text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "core/atomic_file.hpp"
#include "core/number.hpp"

namespace nbvopt {
namespace {

using Figure = std::optional<double>;

/// How people read a figure.
enum class Style { whole, percent, ratio, plain, p_value };

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
    {"drives", "drives", Style::whole, own<&ResultRow::drives>},
    {"voxels", "voxels", Style::whole, own<&ResultRow::voxels>},
    {"voxels_percent", "voxels %", Style::percent, own<&ResultRow::voxels_percent>},
    {"information", "info", Style::whole, own<&ResultRow::information>},
    {"information_least", "least", Style::whole, own<&ResultRow::information_least>},
    {"information_most", "most", Style::whole, own<&ResultRow::information_most>},
    {"ghosts", "ghosts", Style::whole, own<&ResultRow::ghosts>},
    {"gain", "gain", Style::whole, own<&ResultRow::gain>},
    {"gain_percent", "gain %", Style::percent, own<&ResultRow::gain_percent>},
    {"gain_percent_in_papers_time", "gain % in the paper's time", Style::percent,
     own<&ResultRow::gain_percent_in_papers_time>},
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

template <auto member>
Figure compared(const PairedComparison& row) {
  return static_cast<double>(row.*member);
}

constexpr Column<PairedComparison> kComparisonColumns[] = {
    {"motion_time_s", "t (s)", Style::plain, compared<&PairedComparison::motion_time_s>},
    {"pairs", "drives", Style::whole, compared<&PairedComparison::pairs>},
    {"better", "better", Style::whole, compared<&PairedComparison::better>},
    {"mean_percent", "info: mean", Style::percent, compared<&PairedComparison::mean_percent>},
    {"least_percent", "least", Style::percent, compared<&PairedComparison::least_percent>},
    {"most_percent", "most", Style::percent, compared<&PairedComparison::most_percent>},
    {"p", "p", Style::p_value, compared<&PairedComparison::p>},
    {"p_holm", "p (Holm)", Style::p_value, compared<&PairedComparison::holm_p>},
};

std::string percent_digits(double value) { return decimal(value, 2) + "%"; }
std::string ratio_digits(double value) { return decimal(value, 3); }

std::string (*show_of(Style style))(double) {
  switch (style) {
    case Style::whole:
      return grouped;
    case Style::percent:
      return percent_digits;
    case Style::ratio:
      return ratio_digits;
    case Style::plain:
      return format_number;
    case Style::p_value:
      return p_digits;
  }
  return grouped;
}

std::string own_remark(const ResultRow& row) { return row.remark; }
std::string own_remark(const PredictionRow&) { return {}; }

template <class Row>
std::string test_label(const Row& row) {
  const std::string remark = own_remark(row);
  return row.test + (row.motion_time_s ? " (t=" + decimal(*row.motion_time_s, 1) + ")" : "") +
         (remark.empty() ? "" : ": " + remark);
}

TableCell cell(const Figure& figure) {
  return figure.value_or(std::numeric_limits<double>::quiet_NaN());
}

/// What every row has to say, after the cells that tell which it is.
template <class Row>
void append_columns(TextTable& table, std::span<const Column<Row>> columns) {
  for (const Column<Row>& column : columns) {
    table.columns.push_back(
        {column.key, column.heading == nullptr ? "" : column.heading, show_of(column.style)});
  }
}

/// For people an environment's name stands on its first row only, as in the paper.
template <class Row>
TextTable text_table(const std::vector<Row>& rows, std::span<const Column<Row>> columns) {
  TextTable table{{{"", "environment"},
                   {"", "test type"},
                   {"environment", ""},
                   {"test", ""},
                   {"motion_time_s", ""}},
                  {}};
  append_columns(table, columns);
  std::string environment;
  for (const Row& row : rows) {
    std::vector<TableCell>& cells = table.rows.emplace_back();
    cells = {row.environment == environment ? "" : row.environment, test_label(row),
             row.environment, row.test, cell(row.motion_time_s)};
    for (const Column<Row>& column : columns) cells.push_back(cell(column.figure(row)));
    environment = row.environment;
  }
  return table;
}

Json figure_json(const Figure& figure) { return figure ? Json(*figure) : Json(nullptr); }

/// Which row it is, for programs.
template <class Row>
Json label_json(const Row& row) {
  Json label{{"environment", row.environment},
             {"test", row.test},
             {"motion_time_s", figure_json(row.motion_time_s)}};
  if (const std::string remark = own_remark(row); !remark.empty()) label["remark"] = remark;
  return label;
}

Json label_json(const PairedComparison& row) { return {{"test", row.test}, {"other", row.other}}; }

template <class Row>
Json json(const std::vector<Row>& rows, std::span<const Column<Row>> columns) {
  Json all = Json::array();
  for (const Row& row : rows) {
    Json object = label_json(row);
    for (const Column<Row>& column : columns) object[column.key] = figure_json(column.figure(row));
    all.push_back(std::move(object));
  }
  return all;
}

}  // namespace

const char* const kResultNotes = R"(
Figures are means over the drives, one a start and seed, with the least and the most of them for the
information. Every mode captures a frame each t, so each t has a still camera (2D) of its own, which
the rows of that t below it are compared with; of a drive that lacks one of both, the percentages
know nothing. In the paper's time: what a drive knew after as long as the paper's test of that kind
took (NBV: as 2D) against what 2D knew after the paper's 2D. `grid` is the paper's search (pan only,
0.8 rad) and stands beside its 2D+optimisation, `grid-3` is that search over three joints; `auto`
and `random` have no counterpart in the paper. 3D is another exploration with a still camera: it
drives as long as the paper's did and is compared with 2D from the same start at the same t; 3D
tekniker is the same as the paper's authors changed and ran it, 3D after 2D goes on from where 2D
ends, for as long in all. NBV is ours: it drives to where the camera has most to learn, looks as
`auto expected` does, ends by itself and is compared with the same 2D. Voxels are occupied ones with
u < 1 at the finest resolution, info is Eq. 11 over them; ghosts are occupied voxels where the
static world has nothing, where people walk; `as_paper_counts` counts as the authors' code does,
inner nodes of the tree included. `auto` seeks the paper's gain, `auto expected` the expected one.
`oracle` cheats: it takes the best of 100 random views by what they truly bring at the base's next
pose; the regret is what is missing to it at the same t. Mean info is the area below information
over time by the duration, and "to 50 %" when the map knew half of what the best of all modes and t
knew in the end on that drive; where it never came so far, there is no such time. Compare
percentages with the paper's, never absolutes: geometry has no textures here, localisation is
perfect and the exploration is our own.
)";

const char* const kComparisonNotes = R"(
How much more information one test ends with than another from the same start with the same seed,
over all drives in all environments; better: on so many of them. 3D and NBV drive along other ways,
3D for longer. p is Wilcoxon's signed-rank test of these percentages, two-sided, then corrected for
all rows after Holm. Drives in one environment are not independent of each other, so p is somewhat
too small.
)";

const char* const kPredictionNotes = R"(
The gain that a step's search predicted against the gain that its next capture realised, over all
steps of all drives; the bias is how much more was predicted than came. Realised is what the same
48 x 36 rays bring by Eq. 12 where the base has driven meanwhile, with the surfaces that are there:
the search took the base to stand and all that is unknown to be occupied; `auto expected` takes
neither for granted.
)";

TextTable result_table(const ReproductionTable& table) {
  return text_table<ResultRow>(table.results, kResultColumns);
}

TextTable prediction_table(const ReproductionTable& table) {
  return text_table<PredictionRow>(table.predictions, kPredictionColumns);
}

TextTable comparison_table(const ReproductionTable& table) {
  TextTable text{{{"test", "test type"}, {"other", "against"}}, {}};
  append_columns<PairedComparison>(text, kComparisonColumns);
  for (const PairedComparison& row : table.comparisons) {
    std::vector<TableCell>& cells = text.rows.emplace_back();
    cells = {row.test, row.other};
    for (const auto& column : kComparisonColumns) cells.push_back(cell(column.figure(row)));
  }
  return text;
}

std::vector<std::string> hole_notes(const ReproductionTable& table) {
  std::vector<std::string> notes;
  const auto add = [&](const char* what, const std::vector<std::string>& names) {
    constexpr std::size_t kNamed = 12;
    std::string text;
    for (std::size_t i = 0; i < std::min(names.size(), kNamed); ++i) {
      text += (text.empty() ? "" : ", ") + names[i];
    }
    if (names.size() > kNamed) {
      text += " and " + grouped(static_cast<double>(names.size() - kNamed)) +
              " more, which table.json names";
    }
    if (!names.empty()) notes.push_back(what + text + '.');
  };
  add("Missing, since they did not run to their end: ", table.missing);
  add("Not explored to the end, for lack of time: ", table.incomplete);
  return notes;
}

std::string to_markdown(const ReproductionTable& table) {
  std::string text =
      "# The paper's experiment, reproduced\n\n" + to_markdown(result_table(table)) + kResultNotes;
  for (const std::string& note : hole_notes(table)) text += '\n' + note + '\n';
  if (!table.comparisons.empty()) {
    text += "\n## Tests compared\n\n" + to_markdown(comparison_table(table)) + kComparisonNotes;
  }
  return text + "\n## Gain predicted and realised\n\n" + to_markdown(prediction_table(table)) +
         kPredictionNotes;
}

Json to_json(const ReproductionTable& table) {
  return {{"results", json<ResultRow>(table.results, kResultColumns)},
          {"comparisons", json<PairedComparison>(table.comparisons, kComparisonColumns)},
          {"predictions", json<PredictionRow>(table.predictions, kPredictionColumns)},
          {"missing", table.missing},
          {"incomplete_explorations", table.incomplete}};
}

void write_tables(const ReproductionTable& table, const std::filesystem::path& folder) {
  write_file_atomically(folder / "table.md", to_markdown(table));
  write_file_atomically(folder / "table.csv", to_csv(result_table(table)));
  write_file_atomically(folder / "comparison.csv", to_csv(comparison_table(table)));
  write_file_atomically(folder / "prediction.csv", to_csv(prediction_table(table)));
  write_file_atomically(folder / "table.json", to_text(to_json(table)));
}

}  // namespace nbvopt
