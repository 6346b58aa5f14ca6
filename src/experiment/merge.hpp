// Joins the folders in which parts of an experiment were run, such as its shards on many machines.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "core/json.hpp"

namespace nbvopt::experiment {

/// What the records of one kind are to a merge.
struct RecordKind {
  std::string file;  ///< that holds them, in each folder; it may be missing
  std::function<std::string(const Json& record)> id;  ///< of the record's unit
  /// What every run of its unit tells of it in the same way; null: nothing.
  std::function<Json(const Json& record)> repeatable;
};

/// Throws InputError that names both folders when records of one unit contradict each other.
void require_agreement(std::span<const std::filesystem::path> folders, const RecordKind& kind);

struct MergeCount {
  std::size_t added = 0;
  std::size_t repeated = 0;  ///< that were there already
};

/// Appends the records of the parts to those of the folder `into`: a unit's is there once, and an
/// answer rather than a failure. Merging again after a kill goes on. Throws InputError as
/// require_agreement(), which is to be asked first if nothing half-done is to be left, and as
/// RecordFile.
MergeCount merge_records(std::span<const std::filesystem::path> parts,
                         const std::filesystem::path& into, const RecordKind& kind);

}  // namespace nbvopt::experiment
