// Runs the paper's experiment, into a folder where it goes on after a stop.
#pragma once

#include <cstddef>
#include <functional>
#include <istream>
#include <span>
#include <string>
#include <vector>

#include "experiment/coordinator.hpp"
#include "experiment/pool.hpp"
#include "reproduction/record.hpp"

namespace nbvopt {

/// Reads every world and notes its digest in the units that simulate it. Throws InputError when one
/// cannot be read.
void read_worlds(std::span<Unit> units);

/// The same; besides, what was read is kept in the folder and read in the place of the worlds'
/// files. Throws InputError when it cannot be written.
void build_worlds(std::span<Unit> units, const ReproductionFolder& folder);

/// Runs the units without a result, whose worlds must have been read, on workers of one thread
/// each. Every record is in the folder's file before the next; then `on_record` is told of it.
/// Signals and `on_stop` are experiment::run_units()'s. Throws InputError when the folder is used
/// by another run or cannot be written, and as experiment::run_units().
experiment::RunResult run_reproduction(std::span<const Unit> units,
                                       const ReproductionFolder& folder, experiment::Pool& pool,
                                       const std::function<void(const Json& record)>& on_record,
                                       const std::function<void(std::size_t units)>& on_stop = {});

/// For engines that bring workers of their own: visits the units without a result, whose worlds
/// must have been built, as experiment::list_units(). Throws as run_reproduction().
void list_units(std::span<const Unit> units, const ReproductionFolder& folder,
                const std::function<void(const std::string& line)>& visit);

/// Their answers on the way back; what a unit has written must be in its place. Throws as
/// run_reproduction() and experiment::record_answers().
void record_answers(std::span<const Unit> units, const ReproductionFolder& folder,
                    std::istream& answers,
                    const std::function<void(const std::string& id)>& on_kept);

}  // namespace nbvopt
