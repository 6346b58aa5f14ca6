// Runs a study: all its units, or the reference of each of its cases, into the study's folder.
#pragma once

#include <cstddef>
#include <functional>
#include <istream>
#include <string>

#include "experiment/coordinator.hpp"
#include "experiment/pool.hpp"
#include "experiment/shard.hpp"
#include "study/study_file.hpp"

namespace nbvopt::study {

/// What is to be done, and what a run before has done.
struct WorkCount {
  std::size_t total = 0;
  std::size_t done = 0;
  std::size_t failed = 0;  ///< of those that are done
};

/// The groups of units that a study's shards are made of are its cases, with all that is asked.
using experiment::Shard;

struct RunOptions {
  bool retry_failed = false;  ///< whether units that have failed count as not done
  Shard shard = {};
};

/// Counts the queries, or the references, of a study's shard and those with a record. Throws
/// InputError when the records cannot be read.
WorkCount count_work(const Study& study, const StudyFolder& folder, WorkKind kind,
                     const Shard& shard = {});

/// Writes the study into its folder and runs what of the shard has no record there yet; every
/// record is in its file before the next. `on_end` is told of each unit that has ended, with its
/// record; signals and `on_stop` are experiment::run_units()'s. Throws InputError when the folder
/// is used by another run or cannot be written, and as experiment::run_units().
experiment::RunResult run_study(const Study& study, const StudyFolder& folder, WorkKind kind,
                                const RunOptions& options, experiment::Pool& pool,
                                const std::function<void(const Json& record)>& on_end,
                                const std::function<void(std::size_t units)>& on_stop = {});

/// For engines that bring workers of their own: writes the study into its folder and visits what of
/// the shard has no record there yet, as experiment::list_units(). Throws as run_study().
void list_units(const Study& study, const StudyFolder& folder, WorkKind kind,
                const RunOptions& options,
                const std::function<void(const std::string& line)>& visit);

/// Their answers on the way back. Throws as run_study() and experiment::record_answers().
void record_answers(const Study& study, const StudyFolder& folder, WorkKind kind,
                    std::istream& answers,
                    const std::function<void(const std::string& id)>& on_kept);

}  // namespace nbvopt::study
