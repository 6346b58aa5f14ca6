#include "nbvopt/gain/hazard_file.hpp"

#include <algorithm>

#include "core/atomic_file.hpp"
#include "core/json.hpp"
#include "core/text_file.hpp"
#include "fields/keys.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

HazardCount count_in(const Json& json, const std::string& where) {
  HazardCount count;
  KeyCheck keys({"hits", "metres"});
  for (const auto& [key, value] : object_in(json, where).items()) {
    keys.take(key, where, where + '.' + key);
    (key == "hits" ? count.hits : count.metres) = number_in(value, where + '.' + key);
  }
  if (count.hits < 0.0) throw InputError(where + ".hits must be 0 or more");
  if (!(count.metres > 0.0)) throw InputError(where + ".metres must be greater than 0");
  return count;
}

}  // namespace

std::vector<std::string> hazard_context_names() {
  std::vector<std::string> names;
  for (const char* band : {"floor", "middle", "ceiling"}) {
    for (const char* depth : {"entry", "deep"}) {
      for (const char* beside : {"", "_beside_surface"}) {
        names.push_back(std::string("unknown_") + band + '_' + depth + beside);
      }
    }
  }
  names.emplace_back("free_frontier");
  names.emplace_back("free_frontier_beside_surface");
  return names;
}

std::string hazards_json(const HazardTable& hazards) {
  Json contexts = Json::object();
  const std::vector<std::string> names = hazard_context_names();
  for (std::size_t c = 0; c < names.size(); ++c) {
    const HazardCount& count = hazards.count(c);
    contexts[names[c]] = {{"hits", count.hits}, {"metres", count.metres}};
  }
  return to_text(Json{{"floor_map_m", hazards.floor_map_m()}, {"contexts", std::move(contexts)}});
}

void write_hazards(const HazardTable& hazards, const std::filesystem::path& path) {
  write_file_atomically(path, hazards_json(hazards));
}

HazardTable read_hazards(const std::filesystem::path& path) {
  return parse_hazards(read_text_file(path), path.string());
}

HazardTable parse_hazards(const std::string& text, const std::string& name) {
  const Json json = parse_json(text, name);
  double floor_map_m = 0.0;
  const Json* contexts = nullptr;
  KeyCheck keys({"floor_map_m", "contexts"});
  for (const auto& [key, value] : object_in(json, name + ": the file").items()) {
    keys.take(key, name, name + ": " + key);
    if (key == "floor_map_m") floor_map_m = number_in(value, name + ": floor_map_m");
    if (key == "contexts") contexts = &value;
  }
  HazardTable hazards(floor_map_m);
  if (contexts == nullptr) return hazards;
  const std::vector<std::string> names = hazard_context_names();
  KeyCheck known(names);
  for (const auto& [key, value] : object_in(*contexts, name + ": contexts").items()) {
    const std::string where = name + ": contexts." + key;
    known.take(key, name + ": contexts", where);
    const auto place = std::find(names.begin(), names.end(), key);
    hazards.set(static_cast<std::size_t>(place - names.begin()), count_in(value, where));
  }
  return hazards;
}

}  // namespace nbvopt
