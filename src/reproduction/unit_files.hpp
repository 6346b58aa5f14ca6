// Which units are done: the files by which a reproduction goes on where it was stopped.
#pragma once

#include <filesystem>

#include "reproduction/paper_experiment.hpp"

namespace nbvopt {

/// Where a unit's standard error is kept.
std::filesystem::path log_file(const Unit& unit);

/// Whether the unit's files are whole and were made by its command line.
bool is_done(const Unit& unit);

/// Removes what an earlier run left of the unit and notes its command line: to be called before it
/// is run. Throws InputError when that cannot be written.
void prepare(const Unit& unit);

}  // namespace nbvopt
