// Joins the folders in which parts of a study were run, such as its shards on many machines.
#pragma once

#include <cstddef>
#include <span>

#include "study/study_file.hpp"

namespace nbvopt::study {

/// What a merge found in the parts.
struct MergeCount {
  std::size_t records = 0;     ///< queries' that were added
  std::size_t references = 0;  ///< cases' that were added
  std::size_t repeated = 0;    ///< of either, that were there already
};

/// Adds the records of all parts to the folder `into`, which is made if need be and may hold some
/// already. A unit's record is there once, and an answer rather than a failure. Merging again after
/// a kill goes on; records are added only once all of them are known to agree.
///
/// Throws InputError that names both folders when they hold different studies, wherever their maps
/// lie, or records of one unit that differ in more than times (but for units with a time limit, of
/// which the first counts); when a folder holds no study or a damaged one; and when another run
/// uses `into` or it cannot be written.
MergeCount merge_studies(std::span<const StudyFolder> parts, const StudyFolder& into);

}  // namespace nbvopt::study
