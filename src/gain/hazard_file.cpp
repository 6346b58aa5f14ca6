#include "nbvopt/gain/hazard_file.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string_view>

#include "core/atomic_file.hpp"
#include "core/input_file.hpp"
#include "core/json.hpp"
#include "fields/keys.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

constexpr std::string_view kComment = "# nbvopt hazards ";

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

Json to_json(const HazardTable& hazards) {
  Json contexts = Json::object();
  const std::vector<std::string> names = hazard_context_names();
  for (std::size_t c = 0; c < names.size(); ++c) {
    const HazardCount& count = hazards.count(c);
    contexts[names[c]] = {{"hits", count.hits}, {"metres", count.metres}};
  }
  return Json{{"floor_map_m", hazards.floor_map_m()}, {"contexts", std::move(contexts)}};
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

std::string hazards_json(const HazardTable& hazards) { return to_text(to_json(hazards)); }

void write_hazards(const HazardTable& hazards, const std::filesystem::path& path) {
  write_file_atomically(path, hazards_json(hazards));
}

HazardTable read_hazards(const std::filesystem::path& path) {
  std::ifstream in = open_input_file(path);
  if (in.peek() == '#') {
    if (const auto hazards = hazards_in_header(in, path.string())) return *hazards;
    throw InputError(path.string() +
                     ": this map keeps no hazards: give the snapshot of a server whose gain is "
                     "expected, or a JSON file of hazards");
  }
  return parse_hazards(std::string(std::istreambuf_iterator<char>(in), {}), path.string());
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

std::string hazards_comment(const HazardTable& hazards) {
  // Line by line, since a map's header may have no long ones.
  std::istringstream json(hazards_json(hazards));
  std::string comment;
  for (std::string line; std::getline(json, line);) {
    comment += std::string(kComment) + line + '\n';
  }
  return comment;
}

std::optional<HazardTable> hazards_in_header(std::istream& map, const std::string& name) {
  std::string json;
  std::string line;
  while (map.peek() == '#' && std::getline(map, line)) {
    if (line.starts_with(kComment)) json += line.substr(kComment.size()) + '\n';
  }
  if (json.empty()) return std::nullopt;
  return parse_hazards(json, name);
}

}  // namespace nbvopt
