#include <iomanip>
#include <sstream>

#include "core/text_file.hpp"
#include "fields/keys.hpp"
#include "fields/yaml.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/planner/robot.hpp"
#include "nbvopt/planner/robot_fields.hpp"
#include "planner/robot_field_tables.hpp"

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

/// Where the comments start, so that they stand in one column.
constexpr int kCommentColumn = 44;

template <class Options>
void write_block(std::ostream& out, const Options& options) {
  out << block_name(options) << ":\n";
  for (const Field<Options>& field : fields_of(options)) {
    const std::string setting = std::string(field.key) + ": " + to_yaml(field.get(options).value());
    out << "  " << std::left << std::setw(kCommentColumn) << setting << "  # " << field.comment
        << '\n';
  }
}

}  // namespace

Robot read_robot(const std::filesystem::path& path, const Robot& defaults,
                 const UrdfOptions& urdf) {
  return parse_robot(read_text_file(path), path.string(), defaults, urdf);
}

Robot parse_robot(const std::string& text, const std::string& name, const Robot& defaults,
                  const UrdfOptions& urdf) {
  Robot robot = defaults;
  if (is_xml(text)) {
    robot.mast = read_urdf_mast(text, name, urdf).mast;
    return robot;
  }
  if (urdf != UrdfOptions{}) {
    throw InputError(name + ": is no URDF, only with one may the camera's or base's link be given");
  }
  KeyCheck blocks({block_name(robot.sensor), block_name(robot.mast)}, "block");
  for (const auto& [block, node] : entries(parse_yaml(text, name), name)) {
    blocks.take(block, name, name + ": block '" + block + "'");
    const std::vector<FieldSetting> given = settings(node, name + ": " + block);
    if (block == block_name(robot.sensor)) {
      set_fields(robot.sensor, given, name);
    } else {
      set_fields(robot.mast, given, name);
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
