// From the URIs of a world to files.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace nbvopt {

/// Finds what URIs name: `model://name/file` (or with three slashes), `file://path`, paths. Folders
/// are searched for exact names first; then for names that differ in case, and for models whose
/// model.config gives the name.
class ModelPaths {
 public:
  /// Throws InputError when one of the user's folders is not there.
  ModelPaths(const std::filesystem::path& world_folder,
             const std::vector<std::filesystem::path>& user_folders);

  /// The file or folder, none when there is none. Paths are relative to the file that names them
  /// before they are looked for anywhere else.
  std::optional<std::filesystem::path> find(const std::string& uri,
                                            const std::filesystem::path& naming_folder);

 private:
  using FoldersByModel = std::map<std::string, std::filesystem::path>;

  const FoldersByModel& models_in(const std::filesystem::path& folder);
  std::optional<std::filesystem::path> find_loosely(const std::filesystem::path& folder,
                                                    const std::filesystem::path& relative);

  std::vector<std::filesystem::path> folders_;
  std::map<std::filesystem::path, FoldersByModel> models_;  // read when first needed, names folded
};

}  // namespace nbvopt
