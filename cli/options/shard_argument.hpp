// The option --shard of experiments.
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "experiment/shard.hpp"

namespace nbvopt {

/// Adds the option, which takes I/N, I from 1 to N.
void add_shard(CLI::App& command, experiment::Shard& shard, const std::string& description);

}  // namespace nbvopt
