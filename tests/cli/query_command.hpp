// Queries in the room, as arguments and as answers.
#pragma once

#include "cli/command_line.hpp"

namespace nbvopt::test {

using nlohmann::json;
using Arguments = std::vector<std::string>;

/// The arguments of a query in the room, from its middle, with these added.
inline Arguments query(const std::string& map, const Arguments& more = {}) {
  Arguments arguments{"query", map, "--base", "0,0,0", "--height", "0.4", "--motion-time", "0.5"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

inline Arguments json_query(const std::string& map, const Arguments& more = {}) {
  Arguments arguments = query(map, more);
  arguments.emplace_back("--json");
  return arguments;
}

/// The answer without what differs from run to run.
inline json without_times(json answer) {
  for (const char* key : {"time_ms", "map_load_ms", "grid_ms"}) answer.erase(key);
  return answer;
}

}  // namespace nbvopt::test
