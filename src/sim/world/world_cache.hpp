// Built worlds in files, so that the next read takes milliseconds.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>

#include "nbvopt/sim/world.hpp"

namespace nbvopt {

/// The place of one world, read with certain options, in a cache folder.
class WorldCache {
 public:
  WorldCache(const std::filesystem::path& folder, const std::filesystem::path& world_file,
             const WorldOptions& options);

  /// What store() kept. None when there is nothing, it is damaged or of another version of the
  /// format, or one of the files that it was built from has another size or modification time.
  std::optional<World> load() const;

  /// Keeps a world that was built from these files. Throws InputError when it cannot be written.
  void store(const World& world, const std::set<std::filesystem::path>& files) const;

 private:
  std::filesystem::path folder_;
  std::string key_;  // what the world depends on besides files
  std::filesystem::path file_;
};

}  // namespace nbvopt
