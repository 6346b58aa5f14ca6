// The tool as its users run it: the built binary, on small maps.
#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "nbvopt/map/map_file.hpp"
#include "support/paths.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt::test {

/// Runs nbvopt with these arguments.
inline ProcessResult nbvopt_run(const std::vector<std::string>& arguments,
                                const std::string& input = {}) {
  return run_process(cli_program(), arguments, input);
}

/// Runs nbvopt, which must answer, and parses all that it prints as one JSON object.
inline nlohmann::json nbvopt_json(const std::vector<std::string>& arguments,
                                  const std::string& input = {}) {
  const ProcessResult result = nbvopt_run(arguments, input);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return nlohmann::json::parse(result.out, nullptr, false);
}

/// The world of the office that ships.
inline std::string office_world() { return (datasets_dir() / "office.world").string(); }

/// The objects of a file with one JSON object a line.
inline std::vector<nlohmann::json> lines_of(const std::string& file) {
  std::vector<nlohmann::json> objects;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) objects.push_back(nlohmann::json::parse(line));
  return objects;
}

/// Expects a refusal: this exit code, nothing on standard output, one line on standard error that
/// names the thing.
inline void expect_refusal(const ProcessResult& result, int exit_code, const std::string& named) {
  EXPECT_EQ(result.exit_code, exit_code) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, ::testing::StartsWith("nbvopt: "));
  EXPECT_THAT(result.err, ::testing::HasSubstr(named));
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_THAT(result.err, ::testing::EndsWith("\n"));
}

/// A room at 0.1 m: free from -2 to 2 m in x and y and from 0 to 1.5 m in z, but for a wall that
/// fills x from 1.9 to 2 m; all around it is unknown. The wall has this u.
inline UncertaintyMap room(float wall_uncertainty = 0.8F) {
  UncertaintyMap map(0.1);
  const VoxelKey min = map.lattice().key({-1.95, -1.95, 0.05});
  const VoxelKey max = map.lattice().key({1.95, 1.95, 1.45});
  for (int x = min.x; x <= max.x; ++x) {
    for (int y = min.y; y <= max.y; ++y) {
      for (int z = min.z; z <= max.z; ++z) {
        const VoxelKey key{static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
                           static_cast<std::uint16_t>(z)};
        if (x == max.x) {
          map.set(key, {VoxelState::occupied, 2.0F, wall_uncertainty, {255, 255, 255}});
        } else {
          map.set(key, {VoxelState::free, -2.0F, 1.0F, {255, 255, 255}});
        }
      }
    }
  }
  map.finish_writing();
  return map;
}

/// Gives every test the room as a file and a folder to write in.
class CommandLine : public ::testing::Test {
 protected:
  CommandLine() { write_map(room(), map_file, MapFormat::uncertainty_ot); }

  TemporaryFolder folder;
  const std::string map_file = folder / "room.ot";
};

}  // namespace nbvopt::test
