#include <algorithm>
#include <array>
#include <iomanip>
#include <sstream>

#include "core/edit_distance.hpp"
#include "core/number.hpp"
#include "core/text_file.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/planner/robot.hpp"
#include "nbvopt/planner/robot_fields.hpp"
#include "planner/field_table.hpp"
#include "planner/yaml_value.hpp"

namespace nbvopt {
namespace {

/// The keys of a map with their nodes, in the file's order.
std::vector<std::pair<std::string, YAML::Node>> entries(const YAML::Node& map,
                                                        const std::string& name) {
  if (!map.IsMap()) throw InputError(name + ": must hold lines of the form 'key: value'");
  std::vector<std::pair<std::string, YAML::Node>> result;
  for (const auto& entry : map) {
    if (!entry.first.IsScalar()) throw InputError(name + ": a key is not a plain word");
    result.emplace_back(entry.first.Scalar(), entry.second);
  }
  return result;
}

std::vector<FieldSetting> settings(const YAML::Node& block, const std::string& name) {
  std::vector<FieldSetting> result;
  for (const auto& [key, node] : entries(block, name)) {
    result.push_back({key, field_value(node, name + "." + key)});
  }
  return result;
}

std::string to_yaml_value(bool value) { return value ? "true" : "false"; }
std::string to_yaml_value(double value) { return format_number(value); }
std::string to_yaml_value(int value) { return std::to_string(value); }
std::string to_yaml_value(const Eigen::Vector3d& v) {
  std::ostringstream out;
  out << '[' << format_number(v.x()) << ", " << format_number(v.y()) << ", " << format_number(v.z())
      << ']';
  return out.str();
}
template <class Enum>
requires std::is_enum_v<Enum> std::string to_yaml_value(Enum value) { return to_string(value); }

/// Where the comments start, so that they stand in one column.
constexpr int kCommentColumn = 44;

template <class Options>
void write_block(std::ostream& out, const Options& options) {
  out << block_name(options) << ":\n";
  for_each_field(options, [&](const char* key, const auto& field, const char* comment) {
    const std::string setting = std::string(key) + ": " + to_yaml_value(field);
    out << "  " << std::left << std::setw(kCommentColumn) << setting << "  # " << comment << '\n';
  });
}

}  // namespace

Robot read_robot(const std::filesystem::path& path) {
  return parse_robot(read_text_file(path), path.string());
}

Robot parse_robot(const std::string& yaml, const std::string& name) {
  static const std::array<std::string, 2> kBlocks{"sensor", "mast"};
  Robot robot;
  std::vector<std::string> seen;
  for (const auto& [block, node] : entries(parse_yaml(yaml, name), name)) {
    if (std::find(seen.begin(), seen.end(), block) != seen.end()) {
      throw InputError(name + ": block '" + block + "' is given twice, keep one");
    }
    seen.push_back(block);
    if (block == "sensor") {
      set_fields(robot.sensor, settings(node, name + ": " + block), name);
    } else if (block == "mast") {
      set_fields(robot.mast, settings(node, name + ": " + block), name);
    } else {
      throw InputError(name + ": unknown block '" + block + "', did you mean '" +
                       nearest_word(block, kBlocks) + "'?");
    }
  }
  return robot;
}

std::string to_yaml(const Robot& robot) {
  std::ostringstream out;
  write_block(out, robot.sensor);
  write_block(out, robot.mast);
  return out.str();
}

}  // namespace nbvopt
