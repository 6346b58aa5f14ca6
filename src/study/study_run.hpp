// Runs a study: all its units, or the reference of each of its cases, into the study's folder.
#pragma once

#include <cstddef>
#include <functional>
#include <istream>

#include "experiment/coordinator.hpp"
#include "experiment/pool.hpp"
#include "study/study_file.hpp"

namespace nbvopt::study {

/// What is to be done, and what a run before has done.
struct WorkCount {
  std::size_t total = 0;
  std::size_t done = 0;
  std::size_t failed = 0;  ///< of those that are done
};

/// The part of a study that one of several runs does: every count-th case from `index` on, with all
/// that is asked of it.
struct Shard {
  std::size_t index = 0;
  std::size_t count = 1;

  bool has(std::size_t case_index) const { return case_index % count == index; }
};

struct RunOptions {
  bool retry_failed = false;  ///< whether units that have failed count as not done
  Shard shard = {};
};

/// Counts the queries, or the references, of a study's shard and those with a record. Throws
/// InputError when the records cannot be read.
WorkCount count_work(const Study& study, const StudyFolder& folder, WorkKind kind,
                     const Shard& shard = {});

/// Writes the study into its folder and runs what of the
/// shard has no record there yet; every record is in its
/// file before the next. `on_end` is told of each unit that has ended, with its record. Throws
/// InputError when the folder is used by another run or cannot be written, and as
/// experiment::run_units().
experiment::RunResult run_study(const Study& study, const StudyFolder& folder, WorkKind kind,
                                const RunOptions& options, experiment::Pool& pool,
                                const std::function<void(const Json& record)>& on_end);

/// For engines that bring workers of their own: writes the study into its folder and visits what of
/// the shard has no record there yet, as a worker is to get it. Throws as run_study().
void list_units(const Study& study, const StudyFolder& folder, WorkKind kind,
                const RunOptions& options,
                const std::function<void(const experiment::Unit& unit)>& visit);

/// Their answers on the way back, a worker's line each: every record is in its file before the next
/// line is read, and a unit that has an answer keeps it. Gives the number of records. Throws
/// InputError as run_study(), and that names the line of what is no answer to a unit of the study.
std::size_t record_answers(const Study& study, const StudyFolder& folder, WorkKind kind,
                           std::istream& answers);

}  // namespace nbvopt::study
