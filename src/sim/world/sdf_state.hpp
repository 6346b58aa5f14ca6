// What Gazebo saved of a world that had run.
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "sim/world/sdf_documents.hpp"

namespace nbvopt {

/// Where a model stood, in the map, whatever it stands in.
struct SdfModelState {
  std::optional<Eigen::Affine3d> T_map_model;
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();  ///< of each shape, about its own origin
  std::map<std::string, Eigen::Affine3d> T_map_link;
  std::map<std::string, SdfModelState> models;  ///< nested ones
};

/// A <state>: Gazebo puts models and links where it says, adds its insertions and removes its
/// deletions. The default changes nothing.
class SdfState {
 public:
  SdfState() = default;

  /// The first <state> of a world; a value in it that cannot be read is logged.
  SdfState(const SdfElement& world, WorldLog& log);

  /// Null for a model of which nothing is said.
  const SdfModelState* model(const std::string& name) const;
  bool is_deleted(const std::string& name) const { return deletions_.contains(name); }
  const SdfElement* insertions() const { return insertions_; }  ///< holds models; may be null

 private:
  std::map<std::string, SdfModelState> models_;
  std::set<std::string> deletions_;
  const SdfElement* insertions_ = nullptr;
};

/// The state of a model in another's; null for one of which nothing is said.
const SdfModelState* nested_state(const SdfModelState* outer, const std::string& name);

}  // namespace nbvopt
