#include "cli/study_exchange.hpp"

#include <CLI/Option.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "cli/terminal/output.hpp"
#include "study/spec/spec_file.hpp"
#include "study/study_run.hpp"

namespace nbvopt {
namespace {

struct ExchangeOptions {
  std::string spec_file;
  std::string folder;
  bool references = false;
  bool retry_failed = false;

  study::WorkKind kind() const {
    return references ? study::WorkKind::reference : study::WorkKind::query;
  }
};

CLI::App* add_command(CLI::App& study, const char* name, const char* description,
                      ExchangeOptions& options) {
  CLI::App* command = study.add_subcommand(name, description);
  command->add_option("SPEC", options.spec_file, "what is studied, a YAML file")->required();
  command->add_option("--out", options.folder, "the study's folder, made if need be")
      ->type_name("DIR")
      ->required();
  command->add_flag("--references", options.references, "of study reference, not of study run");
  return command;
}

void print_units(const ExchangeOptions& options) {
  list_units(study::read_spec(options.spec_file).study, {options.folder}, options.kind(),
             {.retry_failed = options.retry_failed}, print_line);
}

void record(const ExchangeOptions& options) {
  record_answers(study::read_spec(options.spec_file).study, {options.folder}, options.kind(),
                 std::cin, print_line);
}

}  // namespace

void add_study_exchange(CLI::App& study) {
  auto options = std::make_shared<ExchangeOptions>();
  CLI::App* units = add_command(
      study, "units", "Print what is to be done, a line a unit as workers take it", *options);
  units->add_flag("--retry-failed", options->retry_failed, "units that have failed, too");
  units->callback([options] { print_units(*options); });
  add_command(
      study, "record",
      "Keep workers' answers, lines from standard input, and print the unit of each that is "
      "kept",
      *options)
      ->callback([options] { record(*options); });
}

}  // namespace nbvopt
