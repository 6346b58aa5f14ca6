#include "study/spec/spec_file.hpp"

#include <glob.h>

#include <algorithm>
#include <memory>

#include "core/number.hpp"
#include "core/text_file.hpp"
#include "experiment/digest.hpp"
#include "fields/yaml.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/map_file.hpp"
#include "study/spec/spec_block.hpp"
#include "study/spec/spec_searches.hpp"
#include "study/spec/start_sampling.hpp"
#include "study/unit_message.hpp"

namespace nbvopt::study {
namespace {

namespace fs = std::filesystem;

constexpr double kLongest_s = 1e6;              ///< of time limits
constexpr std::size_t kMostStarts = 1'000'000;  ///< in a map

/// The files that a pattern stands for, in alphabetical order; none when there are none.
std::vector<fs::path> matching_files(const fs::path& pattern) {
  if (fs::exists(pattern)) return {pattern};  // its name may hold a bracket
  glob_t found{};
  const std::unique_ptr<glob_t, void (*)(glob_t*)> guard(&found, ::globfree);
  if (::glob(pattern.c_str(), 0, nullptr, &found) != 0) return {};
  return {found.gl_pathv, found.gl_pathv + found.gl_pathc};
}

/// Reads something that the spec names; its faults are then those of this place.
template <class Read>
auto in_place(const SpecValue& value, const Read& read) {
  try {
    return read();
  } catch (const InputError& error) {
    throw InputError(value.place() + ": " + error.what());
  }
}

class SpecReader {
 public:
  SpecReader(fs::path path, const SolverFactory& make)
      : path_(std::move(path)),
        make_(make),
        spec_({path_.string(), "", parse_yaml(read_text_file(path_), path_.string())},
              {"study", "maps", "optional_maps", "robot", "starts", "motion_times_s",
               "uncertainty_modes", "solvers", "budgets", "seeds", "unit_timeout_s",
               "reference_timeout_s"}) {}

  DeclaredStudy read() {
    read_lists();
    read_maps();
    read_starts();
    return std::move(result_);
  }

 private:
  Study& study() { return result_.study; }
  fs::path beside_spec(const std::string& name) const { return path_.parent_path() / name; }

  void read_lists();
  void read_budgets();
  void read_timeout(const char* key, double& timeout_s) const;
  void read_maps();
  void add_maps(const SpecValue& pattern, bool is_optional);
  void read_starts();
  void sample_starts_of(StudyMap& map, const UncertaintyMap& content,
                        const SpecValue& sampled) const;
  void list_starts(const SpecValue& listed);

  fs::path path_;
  const SolverFactory& make_;
  SpecBlock spec_;
  DeclaredStudy result_;
};

/// Appends a value, refusing one that is there.
template <class Value>
void append_once(std::vector<Value>& values, const Value& value, const SpecValue& given) {
  if (std::ranges::find(values, value) != values.end())
    given.refuse("names a value twice, keep one");
  values.push_back(value);
}

void SpecReader::read_lists() {
  study().name = path_.stem().string();
  if (const auto name = spec_.find("study")) study().name = name->text();
  if (const auto robot = spec_.find("robot")) {
    study().robot = in_place(*robot, [&] { return read_robot(beside_spec(robot->text())); });
  }
  study().searches = read_searches(spec_.require("solvers"), make_);
  add_paper_searches(study().searches);
  for (const SpecValue& time : spec_.require("motion_times_s").elements()) {
    const double time_s = time.number();
    if (time_s < 0.0) {
      time.refuse("is " + format_number(time_s) + " s, it must be 0 (no limit) or more");
    }
    append_once(study().motion_times_s, time_s, time);
  }
  if (const auto modes = spec_.find("uncertainty_modes")) {
    for (const SpecValue& mode : modes->elements()) {
      append_once(study().modes, mode_of(mode.text(), mode.place()), mode);
    }
  } else {
    study().modes = {study().robot.sensor.uncertainty_mode};
  }
  if (const auto seeds = spec_.find("seeds")) {
    for (const SpecValue& seed : seeds->elements()) {
      append_once(study().seeds, static_cast<std::uint64_t>(seed.whole_number(0)), seed);
    }
  } else {
    study().seeds = {1};
  }
  read_budgets();
  read_timeout("unit_timeout_s", study().unit_timeout_s);
  read_timeout("reference_timeout_s", study().reference_timeout_s);
}

void SpecReader::read_budgets() {
  const auto budgets = spec_.find("budgets");
  if (!budgets) {
    study().budgets = {Budget{}};  // as long as a search likes
    return;
  }
  const SpecBlock block(*budgets, {"max_evaluations", "time_limits_ms"});
  if (const auto limits = block.find("max_evaluations")) {
    for (const SpecValue& limit : limits->elements()) {
      append_once(study().budgets, Budget{.max_evaluations = limit.whole_number(1)}, limit);
    }
  }
  if (const auto limits = block.find("time_limits_ms")) {
    for (const SpecValue& limit : limits->elements()) {
      const double limit_ms = limit.number();
      if (limit_ms <= 0.0 || limit_ms > 1e3 * kLongest_s) {
        limit.refuse("is " + format_number(limit_ms) + ", it must be above 0, at most " +
                     format_number(1e3 * kLongest_s));
      }
      append_once(study().budgets, Budget{.time_limit_ms = limit_ms}, limit);
    }
  }
  if (study().budgets.empty()) budgets->refuse("is empty: give max_evaluations or time_limits_ms");
  std::ranges::sort(study().budgets, [](const Budget& a, const Budget& b) {
    const bool a_is_timed = a.time_limit_ms > 0.0;
    const bool b_is_timed = b.time_limit_ms > 0.0;
    if (a_is_timed != b_is_timed) return b_is_timed;
    return a_is_timed ? a.time_limit_ms < b.time_limit_ms : a.max_evaluations < b.max_evaluations;
  });
}

void SpecReader::read_timeout(const char* key, double& timeout_s) const {
  const auto value = spec_.find(key);
  if (!value) return;
  timeout_s = value->number();
  if (timeout_s <= 0.0 || timeout_s > kLongest_s) {
    value->refuse("is " + format_number(timeout_s) + " s, it must be above 0, at most " +
                  format_number(kLongest_s));
  }
}

void SpecReader::read_maps() {
  const auto maps = spec_.find("maps");
  const auto optional_maps = spec_.find("optional_maps");
  if (!maps && !optional_maps) spec_.require("maps");
  if (maps) {
    for (const SpecValue& pattern : maps->elements()) add_maps(pattern, false);
  }
  if (optional_maps) {
    for (const SpecValue& pattern : optional_maps->elements()) add_maps(pattern, true);
  }
  if (study().maps.empty()) optional_maps->refuse("is empty: none of the maps is there");
}

void SpecReader::add_maps(const SpecValue& pattern, bool is_optional) {
  const std::vector<fs::path> files = matching_files(beside_spec(pattern.text()));
  if (files.empty()) {
    const std::string fault = "names no file: " + beside_spec(pattern.text()).string();
    if (!is_optional) pattern.refuse(fault);
    result_.remarks.push_back(pattern.place() + " " + fault + "; left out");
  }
  for (const fs::path& file : files) {
    const std::string name = file.filename().string();
    if (std::ranges::find(study().maps, name, &StudyMap::name) != study().maps.end()) {
      pattern.refuse("names a second map called " + name + ", rename one");
    }
    const std::string content = experiment::file_digest(file);
    const auto twin = std::ranges::find(study().maps, content, &StudyMap::digest);
    if (twin != study().maps.end()) {
      pattern.refuse("names " + name + ", which is the same map as " + twin->name + ", keep one");
    }
    study().maps.push_back({name, file, content, {}});
  }
}

void SpecReader::read_starts() {
  const SpecValue starts = spec_.require("starts");
  const SpecBlock block(starts, {"sampled", "listed"});
  const auto sampled = block.find("sampled");
  const auto listed = block.find("listed");
  if (!sampled == !listed) starts.refuse("must hold either sampled or listed");
  if (listed) list_starts(*listed);
  for (StudyMap& map : study().maps) {
    const UncertaintyMap content = in_place(starts, [&] { return read_map(map.file); });
    if (sampled) sample_starts_of(map, content, *sampled);
  }
}

void SpecReader::sample_starts_of(StudyMap& map, const UncertaintyMap& content,
                                  const SpecValue& sampled) const {
  const SpecBlock block(sampled, {"count", "seed", "base_z_m"});
  const SpecValue number = block.require("count");
  const auto count = static_cast<std::size_t>(number.whole_number(1));
  if (count > kMostStarts) number.refuse("is more than " + std::to_string(kMostStarts));
  const auto seed = block.find("seed") ? block.find("seed")->whole_number(0) : 1;
  const double base_z_m = block.find("base_z_m") ? block.find("base_z_m")->number() : 0.0;
  const auto starts = sample_starts(content, Mast(result_.study.robot.mast), base_z_m, count,
                                    static_cast<std::uint64_t>(seed));
  if (!starts) {
    sampled.refuse("finds no free space in " + map.name + " for a camera on a base at z = " +
                   format_number(base_z_m) + " m, set base_z_m to its floor");
  }
  map.starts = *starts;
}

void SpecReader::list_starts(const SpecValue& listed) {
  const Mast mast(study().robot.mast);
  for (const SpecValue& entry : listed.elements()) {
    const SpecBlock block(entry, {"map", "base", "pan", "tilt", "height"});
    const SpecValue base = block.require("base");
    const std::vector<SpecValue> numbers = base.elements();
    if (numbers.size() != 3 && numbers.size() != 4)
      base.refuse("must be [x, y, yaw] or [x, y, z, yaw]");
    const auto joint = [&block](const char* key, double otherwise) {
      const auto value = block.find(key);
      return value ? value->number() : otherwise;
    };
    Start start{.x_m = numbers[0].number(),
                .y_m = numbers[1].number(),
                .z_m = numbers.size() == 4 ? numbers[2].number() : 0.0,
                .yaw_rad = numbers.back().number(),
                .joints = {joint("pan", 0.0), joint("tilt", 0.0),
                           joint("height", mast.options().height_min_m)}};
    start.joints = in_place(entry, [&] { return mast.clamped(start.joints, result_.remarks); });
    const auto of_map = block.find("map");
    bool is_placed = false;
    for (StudyMap& map : study().maps) {
      if (of_map && map.name != of_map->text()) continue;
      append_once(map.starts, start, entry);
      is_placed = true;
    }
    if (!is_placed)
      of_map->refuse("is '" + of_map->text() + "', which is none of the study's maps");
  }
  for (const StudyMap& map : study().maps) {
    if (map.starts.empty()) listed.refuse("has no start for " + map.name);
  }
}

}  // namespace

DeclaredStudy read_spec(const fs::path& path, const SolverFactory& make) {
  return SpecReader(path, make).read();
}

}  // namespace nbvopt::study
