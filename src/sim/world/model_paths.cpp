#include "sim/world/model_paths.hpp"

#include <algorithm>
#include <cstdlib>
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

/// The local caches of Fuel: where the environment says, or where its programs put them.
std::vector<fs::path> fuel_caches() {
  std::vector<fs::path> caches;
  for (const char* name : {"GZ_FUEL_CACHE_PATH", "IGN_FUEL_CACHE_PATH"}) {
    if (const char* path = std::getenv(name); path != nullptr && *path != '\0') {
      caches.emplace_back(path);
    }
  }
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0') {
    caches.push_back(fs::path(home) / ".gz" / "fuel");
    caches.push_back(fs::path(home) / ".ignition" / "fuel");
  }
  return caches;
}

/// The version in a model's folder of a cache that is asked for, or the newest.
std::optional<fs::path> version_in(const fs::path& model, const std::string& wanted) {
  if (!wanted.empty() && is_there(model / wanted)) return model / wanted;
  const auto number_of = [](const fs::path& folder) {
    return std::atoll(folder.filename().string().c_str());
  };
  const std::vector<fs::path> versions = entries(model);
  const auto newest = std::ranges::max_element(versions, {}, number_of);
  return newest == versions.end() ? std::nullopt : std::optional(*newest);
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
    : fuel_caches_(fuel_caches()) {
  std::vector<fs::path> given{world_folder};
  std::error_code ignored;
  for (const fs::path& folder : user_folders) {
    if (!fs::is_directory(folder, ignored)) {
      throw InputError(folder.string() + ": is not a folder, models are looked for in folders");
    }
    given.push_back(fs::absolute(folder));
  }
  for (const fs::path& folder : given) {
    const fs::path above = folder / "..";
    for (const fs::path& place : {folder, folder / "models", above / "models", above}) {
      if (std::ranges::count(folders_, place) == 0) folders_.push_back(place);
    }
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

std::optional<fs::path> ModelPaths::find_below(const fs::path& relative) {
  for (const fs::path& folder : folders_) {
    if (is_there(folder / relative)) return folder / relative;
  }
  for (const fs::path& folder : folders_) {
    if (auto found = find_loosely(folder, relative)) return found;
  }
  return std::nullopt;
}

std::optional<fs::path> ModelPaths::find_in_fuel_caches(const FuelAddress& address) const {
  for (const fs::path& cache : fuel_caches_) {
    std::vector<fs::path> hosts = entries(cache);
    // Fuel has moved: the same model may lie under the older name of its host.
    std::stable_partition(hosts.begin(), hosts.end(),
                          [&](const fs::path& h) { return h.filename() == address.host; });
    for (const fs::path& host : hosts) {
      const auto model = descend(host, fs::path(address.owner) / "models" / address.name);
      const auto version = model ? version_in(*model, address.version) : std::nullopt;
      if (!version) continue;
      if (auto found = descend(*version, address.rest)) return found;
    }
  }
  return std::nullopt;
}

std::optional<fs::path> ModelPaths::find(const std::string& uri, const fs::path& naming_folder) {
  const auto [known, is_new] = found_.try_emplace({uri, naming_folder});
  if (is_new) known->second = search(uri, naming_folder);
  return known->second;
}

std::optional<fs::path> ModelPaths::search(const std::string& uri, const fs::path& naming_folder) {
  const fs::path named = path_of(uri);
  if (named.relative_path().empty()) return std::nullopt;
  // An absolute path replaces the folder that it is appended to.
  if (is_path(uri) && is_there(naming_folder / named)) return naming_folder / named;
  for (const fs::path& relative : paths_below(uri)) {
    if (auto found = find_below(relative)) return found;
  }
  const std::optional<FuelAddress> address = fuel_address(uri);
  return address ? find_in_fuel_caches(*address) : std::nullopt;
}

std::string ModelPaths::advice(const std::string& uri) {
  if (fuel_address(uri)) {
    return "give the folder of its model as a model path, or download it before (`gz fuel download "
           "-u` with its address)";
  }
  return "give the folder of its model as a model path";
}

}  // namespace nbvopt
