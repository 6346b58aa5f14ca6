#include "reproduction/unit_files.hpp"

#include <string>
#include <system_error>

#include "core/atomic_file.hpp"
#include "core/text_file.hpp"
#include "nbvopt/core/error.hpp"
#include "reproduction/unit_summary.hpp"

namespace nbvopt {
namespace {

namespace fs = std::filesystem;

fs::path beside_summary(const Unit& unit, const std::string& extension) {
  return unit.summary.parent_path() / (unit.name + extension);
}

fs::path command_file(const Unit& unit) { return beside_summary(unit, ".command"); }

std::string command_text(const Unit& unit) { return command_line(unit) + '\n'; }

}  // namespace

fs::path log_file(const Unit& unit) { return beside_summary(unit, ".log"); }

bool is_done(const Unit& unit) {
  try {
    if (read_text_file(command_file(unit)) != command_text(unit)) return false;
    if (unit.episode) {
      read_episode_summary(unit.summary);
    } else {
      read_exploration_summary(unit.summary);
      read_text_file(unit.trajectory);
    }
    return true;
  } catch (const InputError&) {
    return false;  // missing or damaged
  }
}

void prepare(const Unit& unit) {
  std::error_code ignored;
  fs::remove(unit.summary, ignored);  // first, or it would pass for the new command line's
  if (!unit.episode) fs::remove(unit.trajectory, ignored);
  write_file_atomically(command_file(unit), command_text(unit));
}

}  // namespace nbvopt
