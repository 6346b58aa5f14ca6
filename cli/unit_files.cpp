#include "cli/unit_files.hpp"

#include <string>
#include <system_error>

#include "cli/unit_summary.hpp"
#include "core/atomic_file.hpp"
#include "core/text_file.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

namespace fs = std::filesystem;

fs::path beside_summary(const Unit& unit, const std::string& extension) {
  return unit.summary.parent_path() / (unit.name + extension);
}

fs::path command_file(const Unit& unit) { return beside_summary(unit, ".command"); }

/// The command lines that the unit's files come from: a changed exploration changes its episodes.
std::string provenance(std::span<const Unit> units, std::size_t index) {
  const Unit& unit = units[index];
  const std::string own = command_line(unit) + '\n';
  return unit.episode ? command_line(units[unit.exploration]) + '\n' + own : own;
}

}  // namespace

fs::path log_file(const Unit& unit) { return beside_summary(unit, ".log"); }

bool is_done(std::span<const Unit> units, std::size_t index) {
  const Unit& unit = units[index];
  try {
    if (read_text_file(command_file(unit)) != provenance(units, index)) return false;
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

void prepare(std::span<const Unit> units, std::size_t index) {
  const Unit& unit = units[index];
  std::error_code ignored;
  fs::remove(unit.summary, ignored);  // first, or it would pass for the new command line's
  if (!unit.episode) fs::remove(unit.trajectory, ignored);
  write_file_atomically(command_file(unit), provenance(units, index));
}

}  // namespace nbvopt
