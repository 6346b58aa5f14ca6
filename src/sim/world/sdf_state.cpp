#include "sim/world/sdf_state.hpp"

#include "nbvopt/core/error.hpp"

namespace nbvopt {

namespace {

template <class States>
const SdfModelState* find_in(const States& states, const std::string& name) {
  const auto found = states.find(name);
  return found == states.end() ? nullptr : &found->second;
}

std::map<std::string, SdfModelState> models_of(const SdfElement& parent);

SdfModelState model_of(const SdfElement& element) {
  SdfModelState state;
  if (const SdfElement* pose = element.FirstChildElement("pose"))
    state.T_map_model = pose_of(*pose);
  state.scale = vector_of(element, "scale", Eigen::Vector3d(Eigen::Vector3d::Ones()));
  for (const SdfElement* link = element.FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link")) {
    const SdfElement* pose = link->FirstChildElement("pose");
    if (pose != nullptr) state.T_map_link.emplace(attribute_of(*link, "name"), pose_of(*pose));
  }
  state.models = models_of(element);
  return state;
}

std::map<std::string, SdfModelState> models_of(const SdfElement& parent) {
  std::map<std::string, SdfModelState> models;
  for (const SdfElement* model = parent.FirstChildElement("model"); model != nullptr;
       model = model->NextSiblingElement("model")) {
    models.emplace(attribute_of(*model, "name"), model_of(*model));
  }
  return models;
}

}  // namespace

SdfState::SdfState(const SdfElement& world, WorldLog& log) {
  const SdfElement* state = world.FirstChildElement("state");
  if (state == nullptr) return;
  insertions_ = state->FirstChildElement("insertions");
  for (const SdfElement* deletions = state->FirstChildElement("deletions"); deletions != nullptr;
       deletions = deletions->NextSiblingElement("deletions")) {
    for (const SdfElement* name = deletions->FirstChildElement("name"); name != nullptr;
         name = name->NextSiblingElement("name")) {
      deletions_.insert(text_of(name));
    }
  }
  try {
    models_ = models_of(*state);
  } catch (const InputError& error) {
    log.left_out(std::string("the saved <state> is left out: ") + error.what());
  }
}

const SdfModelState* SdfState::model(const std::string& name) const {
  return find_in(models_, name);
}

const SdfModelState* nested_state(const SdfModelState* outer, const std::string& name) {
  return outer == nullptr ? nullptr : find_in(outer->models, name);
}

}  // namespace nbvopt
