#include "nbvopt/sim/camera_mode.hpp"

#include <array>
#include <string_view>
#include <utility>

#include "nbvopt/core/error.hpp"
#include "nbvopt/solver/registry.hpp"
#include "sim/random_views.hpp"

namespace nbvopt {
namespace {

class StaticCamera : public CameraMode {
 public:
  bool plans() const override { return false; }
  NextView next_view(const ViewPlanner& /*planner*/, const PlanRequest& request,
                     const TrueGain& /*true_gain*/) const override {
    return {.joints = request.joints};
  }
};

class SearchingCamera : public CameraMode {
 public:
  explicit SearchingCamera(std::unique_ptr<Solver> solver) : solver_(std::move(solver)) {}

  NextView next_view(const ViewPlanner& planner, const PlanRequest& request,
                     const TrueGain& /*true_gain*/) const override {
    const PlanResult result = planner.plan(request, *solver_);
    NextView next{.joints = result.joints};
    // Others have units of their own, which what is realised does not share.
    if (planner.robot().sensor.gain.is_of_paper()) next.predicted_gain = result.view.gain;
    return next;
  }

 private:
  std::unique_ptr<Solver> solver_;
};

class RandomCamera : public CameraMode {
 public:
  NextView next_view(const ViewPlanner& planner, const PlanRequest& request,
                     const TrueGain& /*true_gain*/) const override {
    return {.joints = RandomViews(planner.reachable_box(request), request.seed).next()};
  }
};

class OracleCamera : public CameraMode {
 public:
  NextView next_view(const ViewPlanner& planner, const PlanRequest& request,
                     const TrueGain& true_gain) const override {
    constexpr int kViews = 100;
    NextView best{.joints = request.joints, .predicted_gain = true_gain(request.joints)};
    RandomViews views(planner.reachable_box(request), request.seed);
    for (int i = 0; i < kViews; ++i) {
      const JointPosition joints = views.next();
      const double gain = true_gain(joints);
      if (gain > best.predicted_gain) best = {.joints = joints, .predicted_gain = gain};
    }
    return best;
  }
};

std::unique_ptr<CameraMode> make_grid(const std::vector<double>& steps) {
  return std::make_unique<SearchingCamera>(make_solver("grid", {.grid_steps = steps}));
}

struct NamedMode {
  std::string_view name;
  std::unique_ptr<CameraMode> (*make)();
};

constexpr std::array kModes{
    NamedMode{"static",
              []() -> std::unique_ptr<CameraMode> { return std::make_unique<StaticCamera>(); }},
    NamedMode{"grid",
              [] {
                return make_grid({0.8, 0.0, 0.0});
              }},
    NamedMode{"grid-3",
              [] {
                return make_grid({0.4, 0.25, 0.075});
              }},
    NamedMode{"auto",
              []() -> std::unique_ptr<CameraMode> {
                return std::make_unique<SearchingCamera>(make_solver("auto", {}));
              }},
    NamedMode{"random",
              []() -> std::unique_ptr<CameraMode> { return std::make_unique<RandomCamera>(); }},
    NamedMode{"oracle",
              []() -> std::unique_ptr<CameraMode> { return std::make_unique<OracleCamera>(); }},
};

}  // namespace

std::vector<std::string> camera_mode_names() {
  std::vector<std::string> names;
  for (const NamedMode& mode : kModes) names.emplace_back(mode.name);
  return names;
}

std::unique_ptr<CameraMode> make_camera_mode(const std::string& name) {
  std::string known;
  for (const NamedMode& mode : kModes) {
    if (mode.name == name) return mode.make();
    known += (known.empty() ? "" : ", ") + std::string(mode.name);
  }
  throw UsageError("there is no camera mode '" + name + "': the modes are " + known);
}

}  // namespace nbvopt
