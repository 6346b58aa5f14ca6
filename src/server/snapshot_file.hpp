// Snapshots: map files (.ot) that also tell which version of the server's map they hold, in a
// comment of the header that other programs skip.
#pragma once

#include <filesystem>
#include <optional>

#include "nbvopt/map/uncertainty_map.hpp"
#include "server/map_store.hpp"

namespace nbvopt {

struct Snapshot {
  UncertaintyMap map;
  std::uint64_t version = 0;  ///< 1 of a map file that tells none
};

/// The snapshot in a file; none when there is no such file. Throws InputError as read_map() does.
std::optional<Snapshot> read_snapshot(const std::filesystem::path& path);

/// Writes a map's bytes of the format uncertainty_ot atomically. Throws as write_file_atomically().
void write_snapshot(const std::filesystem::path& path, const MapBytes& map);

}  // namespace nbvopt
