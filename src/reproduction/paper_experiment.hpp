// The paper's experiment (Section V) as a list of units: what is run, and from where.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/shard.hpp"
#include "reproduction/environments.hpp"
#include "reproduction/simulation_unit.hpp"

namespace nbvopt {

/// What is run on every trajectory: the still camera first for each t, which the rest of that t is
/// compared with.
std::span<const EpisodeSetting> episode_settings();

/// An explorer in space, whose drives are no others': a test of its own.
struct SpatialTest {
  ExplorerKind explorer;
  std::string_view name;   ///< in the tables
  EpisodeSetting setting;  ///< what is run on the drives
  bool is_papers;          ///< its drives end when the paper's 3D exploration did
};

/// The paper's 3D, as it was published and as the paper's authors ran it; what the paper proposes
/// last; and ours.
std::span<const SpatialTest> spatial_tests();

/// Whether the drives of an explorer end with the paper's, and seldom by themselves.
bool ends_with_papers(ExplorerKind explorer);

/// What tests in space are compared with: a still camera, on the drive in the plane.
inline const EpisodeSetting kSpatialReference{"static", 0.5};

/// Where the things of a reproduction lie in its folder.
struct ReproductionFolder {
  std::filesystem::path root;

  std::filesystem::path units() const { return root / "units"; }
  std::filesystem::path worlds() const { return root / "worlds"; }  ///< those that were built
  std::filesystem::path records() const { return root / "records.jsonl"; }
};

/// What `nbvopt reproduce` is to run.
struct ExperimentOptions {
  std::filesystem::path worlds_folder;
  WorldOptions world = {};  ///< how worlds are read
  ReproductionFolder folder;
  std::vector<std::string> environments;  ///< by name; empty: all whose worlds are there
  std::vector<ExplorerKind> explorers;    ///< whose drives are made; empty: all
  std::vector<double> motion_times_s;     ///< of what is run on them; empty: all
  std::int64_t starts = 3;                ///< the first so many of each environment
  std::int64_t seed = 1;
  std::int64_t seeds = 1;  ///< from each start with so many, this one and those after it
  bool has_people = true;  ///< those of the worlds
  /// Of explorations; none: as the environment has it, in space as the paper's Table 2 has it.
  std::optional<double> duration_max_s;
  experiment::Shard shard = {};  ///< of the drives; what is run on a drive stays with it
};

/// A drive that records a trajectory, or an episode on it.
struct Unit {
  std::string name;
  const ExperimentEnvironment* environment = nullptr;
  std::size_t start = 0;  ///< counts from 1
  std::size_t drive = 0;  ///< of an episode: the unit that records its trajectory
  SimulationUnit simulation;

  ExplorerKind explorer = ExplorerKind::plane;  ///< of the drive

  bool is_drive() const { return std::holds_alternative<DriveSetting>(simulation.setting); }
};

/// How tables call what an episode tests: "2D", "2D+<mode>" or "2D+<mode> <gain>" on drives in the
/// plane, as SpatialTest has it on those of explorers in space.
std::string test_name(const EpisodeSetting& setting, ExplorerKind explorer = ExplorerKind::plane);

/// All units of the shard, each drive before its episodes, those of explorers in space last;
/// digests of their worlds are still to be read. Throws as chosen_environments() and starts_in()
/// do.
std::vector<Unit> experiment_units(const ExperimentOptions& options);

/// The command that does a unit's work by itself, as a shell would take it.
std::string command_line(const Unit& unit, const ReproductionFolder& folder);

}  // namespace nbvopt
