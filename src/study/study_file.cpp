#include "study/study_file.hpp"

#include "core/atomic_file.hpp"
#include "core/text_file.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt::study {
namespace {

constexpr int kVersion = 1;

template <class Value, class ToJson>
Json list_json(const std::vector<Value>& values, const ToJson& json_of) {
  Json list = Json::array();
  for (const Value& value : values) list.push_back(json_of(value));
  return list;
}

template <class Value, class FromJson>
std::vector<Value> list_of(const Json& list, const FromJson& value_of) {
  std::vector<Value> values;
  for (const Json& json : list) values.push_back(value_of(json));
  return values;
}

Json map_json(const StudyMap& map) {
  return {{"name", map.name},
          {"file", map.file.string()},
          {"digest", map.digest},
          {"starts", list_json(map.starts, [](const Start& start) { return to_json(start); })}};
}

StudyMap map_of(const Json& json) {
  return {.name = json.at("name").get<std::string>(),
          .file = json.at("file").get<std::string>(),
          .digest = json.at("digest").get<std::string>(),
          .starts = list_of<Start>(json.at("starts"), start_of)};
}

Json study_json(const Study& study) {
  const auto search_json = [](const NamedSearch& named) {
    return Json{{"label", named.label}, {"search", to_json(named.search)}};
  };
  return {{"schema", kVersion},
          {"study", study.name},
          {"maps", list_json(study.maps, map_json)},
          {"motion_times_s", study.motion_times_s},
          {"uncertainty_modes",
           list_json(study.modes, [](UncertaintyMode mode) { return to_string(mode); })},
          {"searches", list_json(study.searches, search_json)},
          {"budgets", list_json(study.budgets, [](const Budget& b) { return to_json(b); })},
          {"seeds", study.seeds},
          {"unit_timeout_s", study.unit_timeout_s},
          {"reference_timeout_s", study.reference_timeout_s}};
}

Study study_of(const Json& json) {
  if (json.at("schema").get<int>() != kVersion) {
    throw InputError("is of another version of this program");
  }
  const auto search_of_named = [](const Json& named) {
    return NamedSearch{named.at("label").get<std::string>(), search_of(named.at("search"))};
  };
  const auto mode_of_name = [](const Json& name) {
    return mode_of(name.get<std::string>(), "unit");
  };
  return {.name = json.at("study").get<std::string>(),
          .robot = {},
          .maps = list_of<StudyMap>(json.at("maps"), map_of),
          .motion_times_s = json.at("motion_times_s").get<std::vector<double>>(),
          .modes = list_of<UncertaintyMode>(json.at("uncertainty_modes"), mode_of_name),
          .searches = list_of<NamedSearch>(json.at("searches"), search_of_named),
          .budgets = list_of<Budget>(json.at("budgets"), budget_of),
          .seeds = json.at("seeds").get<std::vector<std::uint64_t>>(),
          .unit_timeout_s = json.at("unit_timeout_s").get<double>(),
          .reference_timeout_s = json.at("reference_timeout_s").get<double>()};
}

}  // namespace

void write_study(const Study& study, const StudyFolder& folder) {
  write_file_atomically(folder.robot(), to_yaml(study.robot));
  write_file_atomically(folder.study(), study_json(study).dump(1) + '\n');
}

Study read_study(const StudyFolder& folder) {
  const std::string name = folder.study().string();
  try {
    Study study = study_of(Json::parse(read_text_file(folder.study())));
    study.robot = read_robot(folder.robot());
    return study;
  } catch (const Json::exception& error) {
    throw InputError(name + ": is no whole study: " + error.what());
  }
}

}  // namespace nbvopt::study
