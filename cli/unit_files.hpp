// Which units are done: the files by which a reproduction goes on where it was stopped.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "cli/paper_experiment.hpp"

namespace nbvopt {

/// Where a unit's standard error is kept.
std::filesystem::path log_file(const Unit& unit);

/// Whether the unit's files are whole and were made by its command line; those of an episode, on a
/// trajectory that its exploration's command line made.
bool is_done(std::span<const Unit> units, std::size_t index);

/// Removes what an earlier run left of the unit and notes its command line: to be called before it
/// is run. Throws InputError when that cannot be written.
void prepare(std::span<const Unit> units, std::size_t index);

}  // namespace nbvopt
