#include "study/spec/spec_searches.hpp"

#include <algorithm>
#include <utility>

#include "fields/store.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt::study {
namespace {

constexpr const char* kName = "name";

/// A smooth function with a surrogate, as planning has them: what a search needs shows on it.
class TrialSurrogate final : public Objective {
 public:
  const Box& box() const override { return box_; }
  double value(const Point& x) const override { return -x.squaredNorm(); }
  bool has_gradient() const override { return true; }
  double value_and_gradient(const Point& x, Point& gradient) const override {
    gradient = -2.0 * x;
    return value(x);
  }
  bool has_residuals() const override { return true; }
  Eigen::Index residual_count() const override { return 3; }
  double value_and_residuals(const Point& x, Eigen::VectorXd& residuals,
                             Eigen::MatrixXd* jacobian) const override {
    residuals = x;
    if (jacobian) jacobian->setIdentity(3, 3);
    return value(x);
  }

 private:
  Box box_{Point::Constant(3, -1.0), Point::Constant(3, 1.0)};
};

class TrialObjective final : public Objective {
 public:
  const Box& box() const override { return surrogate_.box(); }
  double value(const Point& x) const override { return surrogate_.value(x); }
  const Objective* surrogate() const override { return &surrogate_; }

 private:
  TrialSurrogate surrogate_;
};

/// Finds out whether the search can be made and has what it needs: cancelled beforehand, it checks
/// that and answers with its start.
void try_search(const StudySearch& search, const SpecValue& entry, const SolverFactory& make) {
  try {
    surrogate_options(search, Counting::per_ray).validate();
    SolveRequest request{.start = Point::Zero(3), .stop = {}, .seed = 1};
    request.stop.cancel.cancel();
    make(search.search)->solve(TrialObjective(), request);
  } catch (const Error& error) {
    throw InputError(entry.place() + ": " + error.what());
  }
}

std::vector<std::string> known_keys() {
  std::vector<std::string> keys = search_keys();
  keys.insert(keys.begin(), kName);
  return keys;
}

/// The values that a spec gives a parameter.
struct Parameter {
  std::string key;
  std::vector<SpecValue> values;
};

using Settings = std::vector<FieldSetting>;

/// Every combination of the parameters' values, the last one varying fastest.
std::vector<Settings> product(const std::vector<Parameter>& parameters) {
  std::vector<Settings> combinations{{}};
  for (const Parameter& parameter : parameters) {
    std::vector<Settings> longer;
    for (const Settings& settings : combinations) {
      for (const SpecValue& value : parameter.values) {
        longer.push_back(settings);
        longer.back().push_back({parameter.key, value.finite_scalar()});
      }
    }
    combinations = std::move(longer);
  }
  return combinations;
}

std::string plain_text(const FieldValue& value) {
  const auto* word = std::get_if<std::string>(&value);
  return word != nullptr ? *word : to_text(value);
}

/// "grid, step_pan_rad 0.4": the name or the solver, then what a reader cannot know from it.
std::string label_of(const std::optional<std::string>& name, const StudySearch& search,
                     const Settings& settings, const std::vector<Parameter>& parameters) {
  std::string label = name.value_or(solver_of(search));
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const bool is_told = name ? parameters[i].values.size() == 1 : settings[i].key == "solver";
    if (!is_told) label += ", " + settings[i].key + " " + plain_text(settings[i].value);
  }
  return label;
}

auto find_same(const std::vector<NamedSearch>& searches, const StudySearch& search) {
  return std::ranges::find(searches, settings(search),
                           [](const NamedSearch& named) { return settings(named.search); });
}

void add_searches(const SpecValue& entry, const SolverFactory& make,
                  std::vector<NamedSearch>& searches) {
  static const std::vector<std::string> kKnownKeys = known_keys();
  const SpecBlock block(entry, kKnownKeys);
  std::optional<std::string> name;
  if (const auto value = block.find(kName)) name = value->text();
  std::vector<Parameter> parameters;
  for (const std::string& key : kKnownKeys) {
    if (key == kName) continue;
    if (const auto value = block.find(key)) parameters.push_back({key, value->elements()});
  }
  for (const Settings& settings : product(parameters)) {
    StudySearch search;
    for (const FieldSetting& setting : settings) set_search(search, setting, entry.place());
    check_settings(search, settings, entry.place());
    try_search(search, entry, make);
    const std::string label = label_of(name, search, settings, parameters);
    if (std::ranges::find(searches, label, &NamedSearch::label) != searches.end()) {
      entry.refuse("would make a second search named '" + label + "', give it another name");
    }
    const auto twin = find_same(searches, search);
    if (twin != searches.end()) {
      entry.refuse("would make '" + label + "' the same search as '" + twin->label + "', keep one");
    }
    searches.push_back({label, search});
  }
}

}  // namespace

std::vector<NamedSearch> read_searches(const SpecValue& list, const SolverFactory& make) {
  if (!list.node.IsSequence())
    list.refuse("must be a list of searches, a line '- solver: ...' each");
  std::vector<NamedSearch> searches;
  for (const SpecValue& entry : list.elements()) add_searches(entry, make, searches);
  return searches;
}

void add_paper_searches(std::vector<NamedSearch>& searches) {
  const auto add = [&searches](const std::string& label, double step_pan_rad,
                               const char* evaluator) {
    const StudySearch search{.search = {.solver = "grid", .grid_steps = {step_pan_rad, 0.0, 0.0}},
                             .evaluator = evaluator};
    if (find_same(searches, search) != searches.end()) return;
    searches.push_back({label, search});
  };
  add("paper, released code, step 0.8 rad", 0.8, "paper-code");
  add("paper, step 0.8 rad", 0.8, "exact");
  add("paper, step 0.4 rad", 0.4, "exact");
  add("paper, step 0.2 rad", 0.2, "exact");
}

}  // namespace nbvopt::study
