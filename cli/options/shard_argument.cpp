#include "cli/options/shard_argument.hpp"

#include <CLI/Option.hpp>
#include <cstdint>
#include <sstream>

#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

experiment::Shard shard_of(const std::string& text) {
  std::istringstream in(text);
  std::int64_t part = 0;
  std::int64_t parts = 0;
  char slash = 0;
  constexpr std::int64_t kMost = 1'000'000;
  if (!(in >> part >> slash >> parts) || !in.eof() || slash != '/' || part < 1 || part > parts ||
      parts > kMost) {
    throw UsageError("--shard: '" + text + "' is not I/N with I from 1 to N, such as 1/4");
  }
  return {static_cast<std::size_t>(part - 1), static_cast<std::size_t>(parts)};
}

}  // namespace

void add_shard(CLI::App& command, experiment::Shard& shard, const std::string& description) {
  command
      .add_option_function<std::string>(
          "--shard", [&shard](const std::string& text) { shard = shard_of(text); }, description)
      ->type_name("I/N");
}

}  // namespace nbvopt
