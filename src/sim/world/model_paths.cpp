#include "sim/world/model_paths.hpp"

#include <algorithm>
#include <system_error>

#include "core/text_file.hpp"
#include "nbvopt/core/error.hpp"
#include "sim/world/lower_case.hpp"

namespace nbvopt {

namespace {

namespace fs = std::filesystem;

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

/// What a folder holds, in the order of names; nothing when it cannot be read.
std::vector<fs::path> entries(const fs::path& folder) {
  std::error_code ignored;
  std::vector<fs::path> paths;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    paths.push_back(entry.path());
  }
  std::ranges::sort(paths);
  return paths;
}

/// The path below a folder, whatever the case of its parts.
std::optional<fs::path> descend(fs::path folder, const fs::path& relative) {
  for (const fs::path& part : relative) {
    if (is_there(folder / part)) {
      folder /= part;
      continue;
    }
    const std::vector<fs::path> candidates = entries(folder);
    const auto match = std::ranges::find(
        candidates, lower_case(part.string()),
        [](const fs::path& candidate) { return lower_case(candidate.filename().string()); });
    if (match == candidates.end()) return std::nullopt;
    folder = *match;
  }
  return folder;
}

/// The model's own name in a model.config: the first <name> that is not its author's.
std::string model_name(const std::string& config) {
  std::size_t from = config.find("<name>");
  const std::size_t author = config.find("<author>");
  if (author < from) from = config.find("<name>", config.find("</author>", author));
  const std::size_t to = config.find("</name>", from);
  if (to == std::string::npos) return {};
  from += std::string_view("<name>").size();
  return config.substr(from, to - from);
}

}  // namespace

ModelPaths::ModelPaths(const fs::path& world_folder, const std::vector<fs::path>& user_folders)
    : folders_{world_folder, world_folder / "models", world_folder / ".." / "models"} {
  std::error_code ignored;
  for (const fs::path& folder : user_folders) {
    if (!fs::is_directory(folder, ignored)) {
      throw InputError(folder.string() + ": is not a folder, models are looked for in folders");
    }
    folders_.push_back(fs::absolute(folder));
  }
}

const ModelPaths::FoldersByModel& ModelPaths::models_in(const fs::path& folder) {
  const auto [found, is_new] = models_.try_emplace(folder);
  if (!is_new) return found->second;
  for (const fs::path& model : entries(folder)) {
    if (!is_there(model / "model.config")) continue;
    try {
      found->second.emplace(lower_case(model_name(read_text_file(model / "model.config"))), model);
    } catch (const InputError&) {
      // A model whose name cannot be read is still found by its folder's.
    }
  }
  return found->second;
}

std::optional<fs::path> ModelPaths::find_loosely(const fs::path& folder, const fs::path& relative) {
  if (const auto found = descend(folder, relative)) return found;
  const fs::path name = *relative.begin();
  const FoldersByModel& models = models_in(folder);
  const auto model = models.find(lower_case(name.string()));
  if (model == models.end()) return std::nullopt;
  return descend(model->second, relative.lexically_relative(name));
}

std::optional<fs::path> ModelPaths::find(const std::string& uri, const fs::path& naming_folder) {
  const std::size_t scheme_end = uri.find("://");
  const bool is_path = scheme_end == std::string::npos || uri.starts_with("file://");
  const fs::path named = scheme_end == std::string::npos
                             ? uri
                             : uri.substr(scheme_end + std::string_view("://").size());
  // An absolute path replaces the folder that it is appended to.
  if (is_path && is_there(naming_folder / named)) return naming_folder / named;
  const fs::path relative = named.relative_path().lexically_normal();
  if (relative.empty()) return std::nullopt;
  for (const fs::path& folder : folders_) {
    if (is_there(folder / relative)) return folder / relative;
  }
  for (const fs::path& folder : folders_) {
    if (auto found = find_loosely(folder, relative)) return found;
  }
  return std::nullopt;
}

}  // namespace nbvopt
