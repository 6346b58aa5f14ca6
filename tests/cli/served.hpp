// nbvopt serve as a process, on a socket in a folder of its own.
#pragma once

#include "cli/command_line.hpp"
#include "core/text_file.hpp"
#include "nbvopt/client/planner_client.hpp"
#include "nbvopt/planner/robot.hpp"
#include "server/server_world.hpp"
#include "support/paths.hpp"
#include "support/server_process.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt::test {

/// The folder that servers of a test share, one after the other or side by side.
class ServerFolder {
 public:
  ServerFolder() { folder.write("robot.yaml", to_yaml(small_robot())); }

  std::string snapshot() const { return folder / "snapshot.ot"; }
  std::string socket() const { return "unix:" + (folder / "socket"); }
  std::string log() const { return read_text_file(folder / "log"); }

  /// The arguments of a server that starts empty and keeps a snapshot.
  std::vector<std::string> arguments(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all{
        "serve",      "--create", "0.1",      "--robot", folder / "robot.yaml",
        "--snapshot", snapshot(), "--listen", socket()};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  TemporaryFolder folder;
};

/// A server that is ready, its log in the folder.
class Served : public ServerProcess {
 public:
  Served(const ServerFolder& folder, const std::vector<std::string>& arguments,
         const std::string& program = cli_program())
      : ServerProcess(program, arguments, folder.folder / "log") {}
};

}  // namespace nbvopt::test
