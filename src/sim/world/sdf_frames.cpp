#include "sim/world/sdf_frames.hpp"

#include <cstddef>
#include <utility>
#include <vector>

#include "nbvopt/core/error.hpp"

namespace nbvopt {

namespace {

constexpr const char* kScopeSeparator = "::";
constexpr int kDepthMax = 64;            // of models in each other
constexpr std::size_t kChainMax = 1000;  // of frames given in each other

/// The frame that a pose names: `relative_to`, called `frame` before SDF 1.7. Gazebo 7 to 10 save
/// an empty one with every pose.
std::string frame_of(const SdfElement& pose) {
  std::string frame = attribute_of(pose, "relative_to");
  return frame.empty() ? attribute_of(pose, "frame") : frame;
}

/// The frame in which a part's pose is given when it does not say.
std::string usual_frame_of(const SdfElement& part) {
  if (is_named(part, "frame")) return attribute_of(part, "attached_to");
  if (is_named(part, "joint")) return text_of(part, "child");
  return {};
}

}  // namespace

SdfFrames::SdfFrames(const SdfElement& scope, std::filesystem::path file, std::string name,
                     SdfDocuments& documents)
    : scope_(scope), file_(std::move(file)), name_(std::move(name)), documents_(documents) {}

void SdfFrames::read_names() {
  if (std::exchange(are_names_read_, true)) return;
  for (const char* kind : {"link", "frame", "joint"}) {
    for (const SdfElement* part = scope_.FirstChildElement(kind); part != nullptr;
         part = part->NextSiblingElement(kind)) {
      parts_.try_emplace(attribute_of(*part, "name"), part);
    }
  }
  for (SdfModel& model : documents_.models_in(scope_, file_)) {
    const std::string name = model.name;
    models_.try_emplace(name, std::move(model));
  }
}

Eigen::Affine3d SdfFrames::T_scope(const SdfElement* pose,
                                   const Eigen::Affine3d& T_scope_otherwise) {
  if (pose == nullptr) return T_scope_otherwise;
  const std::string frame = frame_of(*pose);
  if (frame.empty()) return T_scope_otherwise * pose_of(*pose);
  Eigen::Affine3d T_scope_frame = T_scope_otherwise;
  if (!resolve(frame, T_scope_frame)) {
    documents_.log().left_out(name_ + ": frame '" + frame +
                              "' is not known, what is given in it stands where it would without");
  }
  return T_scope_frame * pose_of(*pose);
}

Eigen::Affine3d SdfFrames::T_scope(const SdfModel& model) {
  const Eigen::Affine3d T_scope_placed = T_scope(model.pose);
  if (model.placement_frame.empty()) return T_scope_placed;
  return T_scope_placed * inside(model).T_scope_frame(model.placement_frame).inverse();
}

SdfFrames& SdfFrames::inside(const SdfModel& model) {
  std::unique_ptr<SdfFrames>& frames = insides_[model.name];
  if (!frames) {
    if (depth_ == kDepthMax) {
      throw InputError("model '" + model.name + "' is too deep, does it include itself?");
    }
    frames = std::make_unique<SdfFrames>(*model.element, model.file, "model '" + model.name + "'",
                                         documents_);
    frames->depth_ = depth_ + 1;
  }
  return *frames;
}

Eigen::Affine3d SdfFrames::T_scope_frame(const std::string& frame) {
  Eigen::Affine3d T = Eigen::Affine3d::Identity();
  if (resolve(frame, T)) return T;
  throw InputError("frame '" + frame + "' is not known in " + name_);
}

bool SdfFrames::resolve(const std::string& frame, Eigen::Affine3d& T_scope_frame) {
  if (frame == "__model__" || frame == "world" || frame == "__root__") {
    T_scope_frame.setIdentity();
    return true;
  }
  read_names();
  if (const auto known = known_.find(frame); known != known_.end()) {
    T_scope_frame = known->second;
    return true;
  }
  if (!being_resolved_.insert(frame).second || being_resolved_.size() > kChainMax) {
    throw InputError("frame '" + frame + "' is given in itself");
  }
  bool is_known = true;
  if (const auto part = parts_.find(frame); part != parts_.end()) {
    T_scope_frame = T_scope_part(*part->second);
  } else if (const auto model = models_.find(frame); model != models_.end()) {
    T_scope_frame = T_scope(model->second);
  } else {
    is_known = false;
    for (std::size_t end = frame.find(kScopeSeparator); end != std::string::npos && !is_known;
         end = frame.find(kScopeSeparator, end + 1)) {
      const auto outer = models_.find(frame.substr(0, end));
      is_known = outer != models_.end() &&
                 resolve_inside(outer->second, frame.substr(end + 2), T_scope_frame);
    }
    for (const auto& [name, merged] : models_) {
      if (is_known) break;
      is_known = merged.is_merged && resolve_inside(merged, frame, T_scope_frame);
    }
  }
  being_resolved_.erase(frame);
  if (is_known) known_.emplace(frame, T_scope_frame);
  return is_known;
}

bool SdfFrames::resolve_inside(const SdfModel& model, const std::string& frame,
                               Eigen::Affine3d& T_scope_frame) {
  Eigen::Affine3d T_model_frame = Eigen::Affine3d::Identity();
  if (!inside(model).resolve(frame, T_model_frame)) return false;
  T_scope_frame = T_scope(model) * T_model_frame;
  return true;
}

Eigen::Affine3d SdfFrames::T_scope_part(const SdfElement& part) {
  Eigen::Affine3d T_scope_usual = Eigen::Affine3d::Identity();
  const std::string usual = usual_frame_of(part);
  if (!usual.empty()) T_scope_usual = T_scope_frame(usual);
  return T_scope(part.FirstChildElement("pose"), T_scope_usual);
}

}  // namespace nbvopt
