// Where the parts of a model or a world stand in it.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>

#include "sim/world/sdf_documents.hpp"

namespace nbvopt {

/// The frames of one model, or of a world: its links, joints, <frame>s and models. The frame of the
/// whole is called `scope`. A frame that is not known is logged, and its numbers are taken as given
/// where they would be without it.
class SdfFrames {
 public:
  /// All must outlive it. `name` is for messages: "model 'm'".
  SdfFrames(const SdfElement& scope, std::filesystem::path file, std::string name,
            SdfDocuments& documents);

  /// A pose, given in the frame that it names or, where it names none, in `T_scope_otherwise`; a
  /// null one is the identity there. Throws InputError as pose_of() does, and when frames are given
  /// in each other.
  Eigen::Affine3d T_scope(const SdfElement* pose,
                          const Eigen::Affine3d& T_scope_otherwise = Eigen::Affine3d::Identity());

  /// A model that stands in the scope. Throws as above.
  Eigen::Affine3d T_scope(const SdfModel& model);

 private:
  void read_names();
  Eigen::Affine3d T_scope_frame(const std::string& frame);
  bool resolve(const std::string& frame, Eigen::Affine3d& T_scope_frame);
  bool resolve_inside(const SdfModel& model, const std::string& frame,
                      Eigen::Affine3d& T_scope_frame);
  Eigen::Affine3d T_scope_part(const SdfElement& part);
  SdfFrames& inside(const SdfModel& model);

  const SdfElement& scope_;
  std::filesystem::path file_;
  std::string name_;
  SdfDocuments& documents_;
  int depth_ = 0;  // of scopes in each other
  bool are_names_read_ = false;
  std::map<std::string, const SdfElement*> parts_;  // links, joints, frames
  std::map<std::string, SdfModel> models_;
  std::map<std::string, Eigen::Affine3d> known_;
  std::set<std::string> being_resolved_;
  std::map<std::string, std::unique_ptr<SdfFrames>> insides_;  // by the model's name
};

}  // namespace nbvopt
