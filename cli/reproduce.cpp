#include "cli/reproduce.hpp"

#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <limits>
#include <memory>
#include <set>
#include <thread>
#include <vector>

#include "cli/options/arguments.hpp"
#include "cli/options/shard_argument.hpp"
#include "cli/reproduce_exchange.hpp"
#include "cli/terminal/end_by_signal.hpp"
#include "cli/terminal/output.hpp"
#include "cli/terminal/unit_progress.hpp"
#include "core/atomic_file.hpp"
#include "core/folder.hpp"
#include "experiment/worker.hpp"
#include "experiment/workers.hpp"
#include "nbvopt/core/error.hpp"
#include "reproduction/page.hpp"
#include "reproduction/paper_tables.hpp"
#include "reproduction/reproduction_run.hpp"
#include "reproduction/table.hpp"
#include "reproduction/text.hpp"
#include "reproduction/unit_runner.hpp"

namespace nbvopt {
namespace {

struct ReproduceOptions {
  ExperimentOptions experiment;
  std::int64_t jobs = 0;  ///< processes at a time; 0: one a core
  bool dry_run = false;
  bool tables_only = false;
};

std::size_t count_missing(const std::vector<UnitResult>& results) {
  return static_cast<std::size_t>(std::ranges::count(
      results, false, [](const UnitResult& result) { return result.is_there(); }));
}

/// Those whose worlds are not there.
std::vector<const ExperimentEnvironment*> tell_missing(const ExperimentOptions& experiment) {
  auto missing = missing_environments(experiment.environments, experiment.worlds_folder);
  for (const ExperimentEnvironment* environment : missing) {
    print_message(std::string(environment->name) + " is left out: there is no " +
                  (experiment.worlds_folder / environment->world_file).string());
  }
  return missing;
}

void print_commands(std::vector<Unit> units, const ReproductionFolder& folder) {
  std::string text;
  for (const Unit& unit : units) text += command_line(unit, folder) + '\n';
  std::size_t done = 0;
  // Worlds take time to read, and there may be nothing to compare them with.
  if (std::filesystem::exists(folder.records())) {
    read_worlds(units);
    done = units.size() - count_missing(read_results(units, folder));
  }
  print_answer(text + "# " + std::to_string(units.size()) + " commands, " + std::to_string(done) +
               " of them done\n");
}

/// Runs what has no result yet; the number of units that failed.
std::size_t run_units(const std::vector<Unit>& units, const ReproduceOptions& options,
                      experiment::Pool& pool) {
  const ReproductionFolder& folder = options.experiment.folder;
  UnitProgress progress("reproduce", count_missing(read_results(units, folder)),
                        [](const Json& record) { return record.at("name").get<std::string>(); });
  const auto on_record = [&](const Json& record) { progress.end_unit(record); };
  const auto on_stop = [&](std::size_t at_work) { progress.tell_stop(at_work); };
  const experiment::RunResult result = run_reproduction(units, folder, pool, on_record, on_stop);
  progress.finish();
  if (result.stopped_by) end_by(*result.stopped_by);
  return result.failed;
}

void reproduce(ReproduceOptions options) {
  experiment::Workers workers({"/proc/self/exe", "reproduce", "worker"},
                              options.jobs > 0 ? static_cast<std::size_t>(options.jobs)
                                               : std::max(1U, std::thread::hardware_concurrency()));
  if (workers.is_servant()) return workers.serve();
  options.experiment = with_users_folders(options.experiment);
  const ReproductionFolder& folder = options.experiment.folder;
  std::vector<Unit> units = experiment_units(options.experiment);
  if (!options.dry_run) create_folder(folder.units());  // it is soon known whether that can be done
  const auto missing = tell_missing(options.experiment);
  if (options.dry_run) return print_commands(std::move(units), folder);
  read_worlds(units);
  std::set<std::filesystem::path> worlds;
  for (const Unit& unit : units) worlds.insert(unit.simulation.world.file);
  workers.pool().require_files(std::vector(worlds.begin(), worlds.end()));
  const std::size_t failed = options.tables_only ? 0 : run_units(units, options, workers.pool());
  const std::vector<UnitResult> results = read_results(units, folder);
  const ReproductionTable table = make_table(units, results, missing);
  write_tables(table, folder.root);
  write_file_atomically(folder.root / "report.html", to_html(table, units, results));
  print_answer(to_markdown(table));
  if (failed > 0) {
    throw InputError(std::to_string(failed) + " of " + std::to_string(units.size()) +
                     " units failed; the tables in " + folder.root.string() +
                     " hold the rest, the same command tries again");
  }
}

void simulate_units() {
  UnitRunner runner;
  experiment::run_worker([&](const Json& unit) { return runner.run(simulation_unit_of(unit)); });
}

CLI::App* add_worker(CLI::App& command) {
  CLI::App* worker = command.add_subcommand(
      "worker", "Answer units of work, a line each, from standard input to standard output");
  worker->callback(simulate_units);
  return worker;
}

}  // namespace

void set_up_reproduce(CLI::App& app) {
  auto options = std::make_shared<ReproduceOptions>();
  ExperimentOptions& experiment = options->experiment;
  CLI::App* command = app.add_subcommand("reproduce", "The paper's experiment, with its table");
  CLI::Option* worlds =
      command->add_option("--worlds", experiment.worlds_folder,
                          "the environments, a folder each: simple_house, apartment, ...");
  worlds->type_name("DIR")->required();
  CLI::Option* out = command->add_option("--out", experiment.folder.root,
                                         "what is done so far, and the tables; created if need be");
  out->type_name("DIR")->required();
  command
      ->add_option("--environments", experiment.environments,
                   "only these, with commas: simple_house, apartment, bookstore, cafe, warehouse, "
                   "willowgarage [all whose worlds are there]")
      ->type_name("NAME")
      ->delimiter(',');
  command
      ->add_option_function<std::vector<std::string>>(
          "--explore",
          [&experiment](const std::vector<std::string>& names) {
            for (const std::string& name : names) {
              experiment.explorers.push_back(enum_value<ExplorerKind>(name).value());
            }
          },
          "only the drives of these explorers, with commas, as nbvopt simulate has them; those of "
          "the paper in space are most of the work")
      ->type_name("NAME")
      ->check(CLI::IsMember(enum_names<ExplorerKind>()))
      ->delimiter(',');
  command
      ->add_option("--motion-time", experiment.motion_times_s,
                   "only these t, with commas: 0.2, 0.5, 1")
      ->type_name("SECONDS")
      ->check(
          CLI::IsMember(std::set<double>(kPaperMotionTimes_s.begin(), kPaperMotionTimes_s.end())))
      ->delimiter(',');
  add_whole_number(*command, "--starts", experiment.starts, 1, 3,
                   "only the first so many starts of each environment");
  add_whole_number(*command, "--jobs", options->jobs, 0, 1024,
                   "processes at a time; 0: one a core. Tables do not depend on it");
  add_whole_number(*command, "--seed", experiment.seed, 0, std::numeric_limits<std::int64_t>::max(),
                   "of explorations, searches and people");
  add_whole_number(*command, "--seeds", experiment.seeds, 1, 1000,
                   "with so many from each start: --seed and those after it");
  command->add_flag("!--without-people", experiment.has_people, "leave out the worlds' actors");
  add_number(*command, "--duration-max", experiment.duration_max_s, "SECONDS",
             "end explorations after this, for short trials [3600; 1615 in willowgarage; in 3D as "
             "long as the paper's, for views a third of that if it is more]");
  command->add_flag("--dry-run", options->dry_run,
                    "print the commands, one a line, and their number");
  command->add_flag("--tables-only", options->tables_only,
                    "run nothing, and write the tables of what is done so far");
  add_shard(*command, experiment.shard,
            "do the I-th of N parts only, I from 1 to N, each into a folder of its own; reproduce "
            "merge joins them, and --tables-only then writes the tables");
  add_reproduce_exchange(*command, {options, &options->experiment});
  // Options that are required otherwise are not of these.
  for (CLI::App* other : {add_reproduce_merge(*command), add_worker(*command)}) {
    other->preparse_callback([worlds, out](std::size_t) {
      worlds->required(false);
      out->required(false);
    });
  }
  command->footer(
      "Explores from every start once, then replays each trajectory with the camera still, with\n"
      "the paper's grid and with auto for t = 0.2, 0.5 and 1.0 s, with a grid over three joints "
      "and\n"
      "random views for t = 0.5 s. Explores in 3D, too, alone and after 2D, with a still camera "
      "and\n"
      "t = 0.5 s, and for views, with auto and t = 0.5 s. Prints table.md and writes it to --out,\n"
      "with report.html (all of it with charts and maps), table.csv, comparison.csv,\n"
      "prediction.csv and table.json. What is done already, by the same command, is not run "
      "again.\n"
      "Example: nbvopt reproduce --worlds worlds --out reproduction");
  command->callback([options, command] {
    if (command->get_subcommands().empty()) reproduce(*options);
  });
}

}  // namespace nbvopt
