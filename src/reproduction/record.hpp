// What a reproduction keeps of a unit of work: docs/guide/simulation.md describes the records.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiment/work.hpp"
#include "nbvopt/core/version.hpp"
#include "reproduction/paper_experiment.hpp"
#include "sim/episode_output.hpp"

namespace nbvopt {

/// What came of a unit; none of both records when it has not been run to its end.
struct UnitResult {
  std::optional<DriveReport> drive;
  std::optional<EpisodeReport> episode;
  std::string trajectory_digest = {};  ///< of what was recorded or replayed

  bool is_there() const { return drive || episode; }
};

/// Fingerprints of everything that decides the units' answers: this program's version, the world,
/// start, bounds and seed of a drive; of an episode its drive, mode and t. They do not depend on
/// where files lie. The worlds must have been read.
std::vector<std::string> fingerprints(std::span<const Unit> units,
                                      const std::string& program_version = version());

Json unit_record(const Unit& unit, const std::string& fingerprint,
                 const experiment::Outcome& outcome);

/// The unit's fingerprint. Throws InputError for a record of another schema.
std::string record_id(const Json& record);

/// What the folder's records know of the units, whose worlds must have been read. What was made by
/// another version of this program, from another world or in another way does not count, nor does a
/// drive whose trajectory is no longer what it recorded, nor an episode on another trajectory; of
/// several records of a unit the last one counts. Throws InputError when one is damaged.
std::vector<UnitResult> read_results(std::span<const Unit> units, const ReproductionFolder& folder);

}  // namespace nbvopt
