#include "cli/map_input.hpp"

#include "cli/options/arguments.hpp"
#include "cli/terminal/output.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

MapMessage message_argument(const std::string& text) {
  const auto refuse = [&] {
    throw UsageError("--message " + text + ": give ID,RES,binary or ID,RES,full as the message's " +
                     "fields say, such as OcTree,0.05,binary");
  };
  const std::size_t first = text.find(',');
  const std::size_t last = text.rfind(',');
  if (first == std::string::npos || first == last || first == 0) refuse();
  const std::string kind = text.substr(last + 1);
  if (kind != "binary" && kind != "full") refuse();
  return {.tree_type = text.substr(0, first),
          .resolution_m = number_argument("--message", text.substr(first + 1, last - first - 1)),
          .is_binary = kind == "binary"};
}

}  // namespace

void add_map_input(CLI::App& app, const std::string& name, MapInput& input) {
  app.add_option(name, input.file, "a map: .bt or .ot, also packed (.gz)")->required();
  app.add_option_function<std::string>(
         "--message", [&input](const std::string& text) { input.message = message_argument(text); },
         "the file holds the bytes of `data` of a ROS message octomap_msgs/Octomap with this id, "
         "resolution and kind")
      ->type_name("ID,RES,binary|full");
}

UncertaintyMap read_map_input(const MapInput& input) {
  std::vector<std::string> warnings;
  UncertaintyMap map = input.message ? read_map_message(input.file, *input.message, warnings)
                                     : read_map(input.file, warnings);
  for (const std::string& warning : warnings) {
    print_message("warning: " + input.file + ": " + warning);
  }
  return map;
}

}  // namespace nbvopt
