// The table of a reproduction as text: the same table gives the same bytes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "reproduction/table.hpp"

namespace nbvopt {

/// For people: rounded as the paper rounds, with notes on how to read it.
std::string to_markdown(const ReproductionTable& table);

/// For machines: every figure of ours and of the paper's, not rounded. Cells are empty, and JSON
/// null, where there is none.
std::string to_csv(const std::vector<ResultRow>& rows);
std::string to_csv(const std::vector<PredictionRow>& rows);
Json to_json(const ReproductionTable& table);

/// Writes them into the folder: table.md, table.csv, prediction.csv and table.json. Throws
/// InputError when one cannot be written.
void write_tables(const ReproductionTable& table, const std::filesystem::path& folder);

}  // namespace nbvopt
