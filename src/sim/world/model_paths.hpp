// From the URIs of a world to files.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/world/model_uri.hpp"

namespace nbvopt {

/// Finds what URIs name: `model://name/file` (or with three slashes), `package://name/file`,
/// `file://path`, addresses of Fuel, paths. Each folder is searched, the one above it, and `models`
/// in it; for exact names first, then for names that differ in case, and for models whose
/// model.config gives the name. Nothing is ever fetched from a network: an address of Fuel is
/// looked for by its model's name, then in the local caches of Fuel.
class ModelPaths {
 public:
  /// Throws InputError when one of the user's folders is not there.
  ModelPaths(const std::filesystem::path& world_folder,
             const std::vector<std::filesystem::path>& user_folders);

  /// The file or folder, none when there is none. Paths are relative to the folder of the file that
  /// names them before they are looked for anywhere else.
  std::optional<std::filesystem::path> find(const std::string& uri,
                                            const std::filesystem::path& naming_folder);

  /// What to do about a URI that is not found: "give ... as a model path".
  static std::string advice(const std::string& uri);

 private:
  using FoldersByModel = std::map<std::string, std::filesystem::path>;
  using Key = std::pair<std::string, std::filesystem::path>;

  std::optional<std::filesystem::path> search(const std::string& uri,
                                              const std::filesystem::path& naming_folder);
  std::optional<std::filesystem::path> find_below(const std::filesystem::path& relative);
  std::optional<std::filesystem::path> find_in_fuel_caches(const FuelAddress& address) const;
  std::optional<std::filesystem::path> find_loosely(const std::filesystem::path& folder,
                                                    const std::filesystem::path& relative);
  const FoldersByModel& models_in(const std::filesystem::path& folder);

  std::vector<std::filesystem::path> folders_;      // in the order in which they are searched
  std::vector<std::filesystem::path> fuel_caches_;  // of this user
  std::map<std::filesystem::path, FoldersByModel> models_;  // read when first needed, names folded
  std::map<Key, std::optional<std::filesystem::path>> found_;
};

}  // namespace nbvopt
