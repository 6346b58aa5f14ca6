#include "office_world.hpp"

#include <sstream>
#include <string_view>

#include "office_scene.hpp"

namespace nbvopt {
namespace {

void add_box(std::ostream& out, std::string_view element, std::size_t number,
             const Eigen::Vector3d& size_m) {
  out << "        <" << element << " name=\"" << number << "\"><geometry><box><size>" << size_m.x()
      << ' ' << size_m.y() << ' ' << size_m.z() << "</size></box></geometry></" << element << ">\n";
}

}  // namespace

std::string office_world() {
  std::ostringstream out;
  out << "<?xml version=\"1.0\"?>\n"
         "<!-- Made by make_office_world; the same office as office_partial.ot knows a part of. "
         "-->\n"
         "<sdf version=\"1.6\">\n"
         "  <world name=\"office\">\n"
         "    <model name=\"office\">\n"
         "      <static>true</static>\n";
  std::size_t number = 0;
  for (const SceneBox& box : office_boxes()) {
    const Eigen::Vector3d centre_m = 0.5 * (box.min_m + box.max_m);
    out << "      <link name=\"" << number << "\">\n        <pose>" << centre_m.x() << ' '
        << centre_m.y() << ' ' << centre_m.z() << " 0 0 0</pose>\n";
    for (const std::string_view element : {"visual", "collision"}) {
      add_box(out, element, number, box.max_m - box.min_m);
    }
    out << "      </link>\n";
    ++number;
  }
  out << "    </model>\n  </world>\n</sdf>\n";
  return out.str();
}

}  // namespace nbvopt
