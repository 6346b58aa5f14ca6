// Writes down what a study found.
#pragma once

#include <filesystem>

#include "study/results.hpp"

namespace nbvopt {

/// Writes report.md, its tables as CSV files and its pictures into a folder, which is made where it
/// is missing. Throws UsageError for a study without solvers or budgets, and InputError that names
/// what cannot be written; each file is whole or as it was.
void write_report(const study::Results& results, const std::filesystem::path& folder);

}  // namespace nbvopt
