#include "nbvopt/gain/gain_model.hpp"

#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

struct KnownModel {
  const char* name;
  std::unique_ptr<GainModel> (*make)(const DepthCamera& camera);
};

/// Every gain model; a new one gets a line here.
constexpr KnownModel kModels[] = {{"paper", make_paper_gain}};

}  // namespace

std::vector<std::string> gain_model_names() {
  std::vector<std::string> names;
  for (const KnownModel& model : kModels) names.emplace_back(model.name);
  return names;
}

std::unique_ptr<GainModel> make_gain_model(const std::string& name, const DepthCamera& camera) {
  std::string known;
  for (const KnownModel& model : kModels) {
    if (name == model.name) return model.make(camera);
    known += std::string(known.empty() ? "" : ", ") + model.name;
  }
  throw UsageError("unknown gain model '" + name + "'; known: " + known);
}

}  // namespace nbvopt
