// Joins the folders in which parts of a reproduction were run, such as its shards on many machines.
#pragma once

#include <span>

#include "experiment/merge.hpp"
#include "reproduction/paper_experiment.hpp"

namespace nbvopt {

/// Adds the records of all parts, their trajectories and pictures to the folder `into`, which is
/// made if need be and may hold some already. Merging again after a kill goes on; nothing is added
/// before all parts are known to agree. Pictures are those of the first part that has them.
///
/// Throws InputError that names both folders when records of one unit differ in more than times and
/// where worlds lie, or trajectories of one name differ at all; when a part holds no reproduction;
/// and when the folder is used by another run or cannot be written.
experiment::MergeCount merge_reproductions(std::span<const ReproductionFolder> parts,
                                           const ReproductionFolder& into);

}  // namespace nbvopt
