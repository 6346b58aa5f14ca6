#include "cli/reproduce.hpp"

#include <CLI/Option.hpp>
#include <algorithm>
#include <limits>
#include <memory>
#include <thread>

#include "cli/options/arguments.hpp"
#include "cli/reproduction.hpp"

namespace nbvopt {

void set_up_reproduce(CLI::App& app) {
  auto options = std::make_shared<ReproduceOptions>();
  auto jobs = std::make_shared<std::int64_t>(0);
  ExperimentOptions& experiment = options->experiment;
  CLI::App* command = app.add_subcommand("reproduce", "The paper's experiment, with its table");
  command
      ->add_option("--worlds", experiment.worlds_folder,
                   "the environments, a folder each: simple_house, apartment, ...")
      ->type_name("DIR")
      ->required();
  command
      ->add_option("--out", experiment.output_folder,
                   "what is done so far, and the tables; created if need be")
      ->type_name("DIR")
      ->required();
  command
      ->add_option(
          "--environments", experiment.environments,
          "only these, with commas: simple_house, apartment, cafe, warehouse, willowgarage")
      ->type_name("NAME")
      ->delimiter(',');
  add_whole_number(*command, "--starts", experiment.starts, 1, 3,
                   "only the first so many starts of each environment");
  add_whole_number(*command, "--jobs", *jobs, 0, 1024,
                   "processes at a time; 0: one a core. Tables do not depend on it");
  add_whole_number(*command, "--seed", experiment.seed, 0, std::numeric_limits<std::int64_t>::max(),
                   "of explorations and searches");
  add_number(*command, "--duration-max", experiment.duration_max_s, "SECONDS",
             "end explorations after this, for short trials [3600; 1615 in willowgarage]");
  command->add_flag("--dry-run", options->dry_run,
                    "print the commands, one a line, and their number");
  command->footer(
      "Explores from every start once, then replays each trajectory with the camera still, with\n"
      "the paper's grid and with auto for t = 0.2, 0.5 and 1.0 s, with a grid over three joints "
      "and\n"
      "random views for t = 0.5 s. Prints table.md and writes it to --out, with table.csv,\n"
      "prediction.csv and table.json. What is done already, by the same command, is not run "
      "again.\n"
      "Example: nbvopt reproduce --worlds worlds --out reproduction");
  command->callback([options, jobs] {
    options->jobs = *jobs > 0 ? static_cast<std::size_t>(*jobs)
                              : std::max(1U, std::thread::hardware_concurrency());
    reproduce(*options);
  });
}

}  // namespace nbvopt
