// The tables of a reproduction as text: the same tables give the same bytes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "report/text_table.hpp"
#include "reproduction/table.hpp"

namespace nbvopt {

// For people rounded as the paper rounds; for machines every figure of ours and of the paper's,
// not rounded.

TextTable result_table(const ReproductionTable& table);
TextTable comparison_table(const ReproductionTable& table);
TextTable prediction_table(const ReproductionTable& table);

// How to read them, in Markdown.

extern const char* const kResultNotes;
extern const char* const kComparisonNotes;
extern const char* const kPredictionNotes;
/// What the tables lack; a sentence a kind.
std::vector<std::string> hole_notes(const ReproductionTable& table);

/// All of it for people.
std::string to_markdown(const ReproductionTable& table);

/// All of it for machines; null where there is no figure.
Json to_json(const ReproductionTable& table);

/// Writes table.md, table.csv, comparison.csv, prediction.csv and table.json into the folder.
/// Throws InputError when one cannot be written.
void write_tables(const ReproductionTable& table, const std::filesystem::path& folder);

}  // namespace nbvopt
