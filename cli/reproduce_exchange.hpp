// `nbvopt reproduce units`, `record` and `merge`: a reproduction on other engines and in parts.
#pragma once

#include <CLI/App.hpp>
#include <memory>

#include "reproduction/paper_experiment.hpp"

namespace nbvopt {

/// Adds units and record, which take the options of `reproduce` as well.
void add_reproduce_exchange(CLI::App& reproduce,
                            const std::shared_ptr<const ExperimentOptions>& options);

/// Adds merge.
CLI::App* add_reproduce_merge(CLI::App& reproduce);

/// The options, with where worlds are looked for and kept.
ExperimentOptions with_users_folders(ExperimentOptions options);

}  // namespace nbvopt
