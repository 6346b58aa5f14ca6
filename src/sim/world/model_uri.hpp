// What the URIs of a world say.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace nbvopt {

/// `https://host/1.0/owner/models/name[/version][/files/rest]`.
struct FuelAddress {
  std::string host;
  std::string owner;
  std::string name;
  std::string version = {};         ///< empty: the newest
  std::filesystem::path rest = {};  ///< below the model's folder; empty: the folder itself
};

/// None for what is no address of a model on a Fuel server.
std::optional<FuelAddress> fuel_address(const std::string& uri);

/// Whether it is a path, with or without `file://`.
bool is_path(const std::string& uri);

/// What follows the scheme, with `%20` and the like decoded.
std::filesystem::path path_of(const std::string& uri);

/// Where a URI may lead below a folder of models, the likeliest first: as it is written; without
/// the package of `package://`; from its `models` folder on, and below that.
std::vector<std::filesystem::path> paths_below(const std::string& uri);

}  // namespace nbvopt
