#include "cli/reproduce_exchange.hpp"

#include <CLI/Option.hpp>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "cli/terminal/output.hpp"
#include "reproduction/merge.hpp"
#include "reproduction/reproduction_run.hpp"

namespace nbvopt {
namespace {

void print_units(const ExperimentOptions& options) {
  std::vector<Unit> units = experiment_units(with_users_folders(options));
  build_worlds(units, options.folder);
  list_units(units, options.folder, print_line);
}

void record(const ExperimentOptions& options) {
  std::vector<Unit> units = experiment_units(with_users_folders(options));
  read_worlds(units);
  record_answers(units, options.folder, std::cin, print_line);
}

}  // namespace

ExperimentOptions with_users_folders(ExperimentOptions options) {
  options.world = {.model_paths = gazebo_model_paths(), .cache_folder = user_cache_folder()};
  return options;
}

void add_reproduce_exchange(CLI::App& reproduce,
                            const std::shared_ptr<const ExperimentOptions>& options) {
  reproduce
      .add_subcommand("units",
                      "Print what is to be done, a line a unit as workers take it; takes "
                      "the options of reproduce")
      ->fallthrough()
      ->callback([options] { print_units(*options); });
  reproduce
      .add_subcommand("record",
                      "Keep workers' answers, lines from standard input, and print the "
                      "unit of each that is kept; takes the options of reproduce")
      ->fallthrough()
      ->callback([options] { record(*options); });
}

CLI::App* add_reproduce_merge(CLI::App& reproduce) {
  auto parts = std::make_shared<std::vector<std::string>>();
  auto into = std::make_shared<std::string>();
  CLI::App* command = reproduce.add_subcommand(
      "merge", "Join the folders of parts of a reproduction, such as its shards, into DIR");
  command->add_option("PARTS", *parts, "the folders")->required();
  command->add_option("--out", *into, "the folder that takes up what is done, made if need be")
      ->type_name("DIR")
      ->required();
  command->callback([parts, into] {
    std::vector<ReproductionFolder> folders;
    for (const std::string& part : *parts) folders.push_back({part});
    const experiment::MergeCount count = merge_reproductions(folders, {*into});
    print_answer(std::to_string(count.added) + " records added, " + std::to_string(count.repeated) +
                 " were there\n");
  });
  return command;
}

}  // namespace nbvopt
