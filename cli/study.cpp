#include "cli/study.hpp"

#include <CLI/Option.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "cli/options/arguments.hpp"
#include "cli/options/shard_argument.hpp"
#include "cli/study_exchange.hpp"
#include "cli/terminal/end_by_signal.hpp"
#include "cli/terminal/output.hpp"
#include "cli/terminal/unit_progress.hpp"
#include "core/json.hpp"
#include "experiment/worker.hpp"
#include "experiment/workers.hpp"
#include "nbvopt/core/error.hpp"
#include "study/merge.hpp"
#include "study/record.hpp"
#include "study/report/report.hpp"
#include "study/spec/spec_file.hpp"
#include "study/study_run.hpp"
#include "study/unit_runner.hpp"

namespace nbvopt {
namespace {

using study::WorkKind;

struct StudyOptions {
  std::string spec_file;
  std::string folder;
  std::int64_t workers = 0;  ///< 0: one a core
  std::string worker_command;
  experiment::Shard shard;
  bool dry_run = false;
  bool retry_failed = false;
};

std::string plural(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : noun.ends_with('h') ? "es" : "s");
}

std::string to_text(const study::Study& study, const study::WorkCount& work, std::size_t to_run,
                    WorkKind kind) {
  std::size_t starts = 0;
  for (const study::StudyMap& map : study.maps) starts += map.starts.size();
  std::string text = plural(study.maps.size(), "map") + ", " + plural(starts, "start") + ", " +
                     plural(study.motion_times_s.size(), "motion time") + ", " +
                     plural(study.modes.size(), "uncertainty mode") + ": " +
                     plural(study::case_count(study), "case") + '\n';
  if (kind == WorkKind::query) {
    text += plural(study.searches.size(), "search") + ", " +
            plural(study.budgets.size(), "budget") + ", " + plural(study.seeds.size(), "seed") +
            ": " + plural(work.total, "unit") + '\n';
  }
  return text + std::to_string(work.done) + " done (" + std::to_string(work.failed) + " failed), " +
         std::to_string(to_run) + " to run\n";
}

std::vector<std::string> words(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> result;
  for (std::string word; in >> word;) result.push_back(word);
  return result;
}

experiment::Workers workers_of(const StudyOptions& options) {
  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  return {options.worker_command.empty()
              ? std::vector<std::string>{"/proc/self/exe", "study", "worker"}
              : words(options.worker_command),
          options.workers > 0 ? static_cast<std::size_t>(options.workers) : cores};
}

/// What was done, and how well the workers were used.
std::string to_text(const experiment::RunResult& result, std::size_t workers) {
  if (result.finished == 0) return "nothing to do: every unit has its record\n";
  const double count = static_cast<double>(result.finished);
  const double share = result.busy_ms / (result.wall_ms * static_cast<double>(workers));
  const double overhead_ms =
      result.wall_ms * static_cast<double>(workers) / count - result.busy_ms / count;
  std::array<char, 200> text{};
  std::snprintf(
      text.data(), text.size(),
      "%zu units in %.1f s, %zu of them failed\n"
      "%.2f ms a unit, %zu workers busy for %.1f %% of the time, overhead %.3f ms a unit\n",
      result.finished, result.wall_ms / 1e3, result.failed, result.busy_ms / count, workers,
      100.0 * share, overhead_ms);
  return text.data();
}

void run(const StudyOptions& options, WorkKind kind) {
  experiment::Workers workers = workers_of(options);
  if (workers.is_servant()) return workers.serve();
  const study::DeclaredStudy declared = study::read_spec(options.spec_file);
  for (const std::string& remark : declared.remarks) print_message("warning: " + remark);
  const study::Study& study = declared.study;
  const study::StudyFolder folder{options.folder};
  const study::WorkCount work = study::count_work(study, folder, kind, options.shard);
  const std::size_t to_run = work.total - work.done + (options.retry_failed ? work.failed : 0);
  print_answer(to_text(study, work, to_run, kind));
  if (options.dry_run) return;

  std::vector<std::filesystem::path> maps;
  for (const study::StudyMap& map : study.maps) maps.push_back(map.file);
  workers.pool().require_files(maps);
  UnitProgress progress("study", to_run, study::record_id);
  const auto on_end = [&](const Json& record) { progress.end_unit(record); };
  const auto on_stop = [&](std::size_t units) { progress.tell_stop(units); };
  const experiment::RunResult result = study::run_study(
      study, folder, kind, {.retry_failed = options.retry_failed, .shard = options.shard},
      workers.pool(), on_end, on_stop);
  progress.finish();
  if (result.stopped_by) end_by(*result.stopped_by);
  print_answer(to_text(result, std::min(workers.count(), std::max<std::size_t>(to_run, 1))));
}

void answer_queries() {
  study::UnitRunner runner([](const Search& search) { return make_solver(search); });
  experiment::run_worker([&](const Json& unit) { return runner.run(study::unit_of(unit)); });
}

void report(const study::StudyFolder& folder, study::Against against) {
  const study::Results results = study::read_results(study::read_study(folder), folder, against);
  write_report(results, folder.report());
  print_answer("the report is in " + (folder.report() / "report.md").string() + '\n');
}

void add_report(CLI::App& study) {
  auto folder = std::make_shared<std::string>();
  CLI::App* command = study.add_subcommand(
      "report", "Write tables, CSV files and pictures of what was found into DIR/report");
  command->add_option("DIR", *folder, "the study's folder")->required();
  auto against_bound = std::make_shared<bool>(false);
  command->add_flag("--against-bound", *against_bound,
                    "measure answers against what the references proved that no view exceeds, "
                    "instead of the best that is known");
  command->callback([folder, against_bound] {
    report({*folder}, *against_bound ? study::Against::upper_bound : study::Against::best_known);
  });
}

void add_merge(CLI::App& study) {
  auto parts = std::make_shared<std::vector<std::string>>();
  auto into = std::make_shared<std::string>();
  CLI::App* command = study.add_subcommand(
      "merge", "Join the folders of runs of one study, such as its shards, into DIR");
  command->add_option("PARTS", *parts, "the folders")->required();
  command->add_option("--out", *into, "the folder that takes up their records, made if need be")
      ->type_name("DIR")
      ->required();
  command->callback([parts, into] {
    std::vector<study::StudyFolder> folders;
    for (const std::string& part : *parts) folders.push_back({part});
    const study::MergeCount count = study::merge_studies(folders, {*into});
    print_answer(plural(count.records, "record") + " and " + plural(count.references, "reference") +
                 " added, " + std::to_string(count.repeated) + " were there\n");
  });
}

void add_run_arguments(CLI::App& command, StudyOptions& options) {
  command.add_option("SPEC", options.spec_file, "what is studied, a YAML file")->required();
  command.add_option("--out", options.folder, "the study's folder, made if need be")
      ->type_name("DIR")
      ->required();
  command.add_flag("--dry-run", options.dry_run, "only count what is to be done");
  add_whole_number(
      command, "--workers", options.workers, 0, 1024,
      "processes that work side by side; 0: one a core; under mpirun one a rank but the "
      "first. Answers do not depend on it");
  command
      .add_option("--worker-command", options.worker_command,
                  "what starts a worker, words with blanks between them [this program]")
      ->type_name("COMMAND");
  command.add_flag("--retry-failed", options.retry_failed, "run units again that have failed");
  add_shard(
      command, options.shard,
      "do the I-th of N parts only, I from 1 to N, each into a folder of its own; study merge "
      "joins them");
}

void add_run(CLI::App& study, const char* name, const char* description, WorkKind kind) {
  auto options = std::make_shared<StudyOptions>();
  CLI::App* command = study.add_subcommand(name, description);
  add_run_arguments(*command, *options);
  command->callback([options, kind] { run(*options, kind); });
}

}  // namespace

void set_up_study(CLI::App& app) {
  CLI::App* study = app.add_subcommand("study", "Compare searches on many questions");
  study->require_subcommand(1);
  add_run(*study, "run", "Ask every question of every search; goes on where it was stopped",
          WorkKind::query);
  add_run(*study, "reference", "Find the best view of every question, by exhaustive search",
          WorkKind::reference);
  add_merge(*study);
  add_study_exchange(*study);
  add_report(*study);
  study
      ->add_subcommand("worker",
                       "Answer units of work, a line each, from standard input to standard output")
      ->callback(answer_queries);
  study->footer("Keys of SPEC, records and the workers' protocol: docs/guide/studies.md");
}

}  // namespace nbvopt
