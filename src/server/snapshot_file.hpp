// Snapshots: map files (.ot) that also tell which version of the server's map they hold, and what
// its scans have taught, in comments of the header that other programs skip: one file, so that
// nothing gets out of step.
#pragma once

#include <filesystem>
#include <optional>

#include "nbvopt/map/uncertainty_map.hpp"
#include "server/map_store.hpp"

namespace nbvopt {

struct Snapshot {
  UncertaintyMap map;
  std::uint64_t version = 0;           ///< 1 of a map file that tells none
  std::optional<HazardTable> hazards;  ///< none of a map file that tells none
};

/// The snapshot in a file; none when there is no such file. Throws InputError as read_map() and
/// read_hazards() do.
std::optional<Snapshot> read_snapshot(const std::filesystem::path& path);

/// Writes a map's bytes of the format uncertainty_ot atomically. Throws as write_file_atomically().
void write_snapshot(const std::filesystem::path& path, const MapBytes& map);

}  // namespace nbvopt
