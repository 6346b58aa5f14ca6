#include "cli/reproduction.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include "cli/terminal/end_by_signal.hpp"
#include "cli/terminal/exit_code.hpp"
#include "cli/terminal/output.hpp"
#include "cli/terminal/progress.hpp"
#include "core/atomic_file.hpp"
#include "core/folder.hpp"
#include "core/json.hpp"
#include "experiment/job_pool.hpp"
#include "nbvopt/core/error.hpp"
#include "reproduction/table.hpp"
#include "reproduction/text.hpp"
#include "reproduction/unit_files.hpp"
#include "reproduction/unit_summary.hpp"

namespace nbvopt {
namespace {

namespace fs = std::filesystem;

std::vector<std::size_t> units_to_run(const std::vector<Unit>& units) {
  std::vector<bool> is_awaited(units.size());
  std::vector<std::size_t> to_run;
  for (std::size_t i = 0; i < units.size(); ++i) {
    // A trajectory that is made again need not be the one that the episode was run on.
    is_awaited[i] = !is_done(units[i]) || (units[i].episode && is_awaited[units[i].exploration]);
    if (is_awaited[i]) to_run.push_back(i);
  }
  return to_run;
}

void print_commands(const std::vector<Unit>& units) {
  std::string text;
  for (const Unit& unit : units) text += command_line(unit) + '\n';
  print_answer(text + "# " + std::to_string(units.size()) + " commands, " +
               std::to_string(units.size() - units_to_run(units).size()) + " of them done\n");
}

std::vector<Job> jobs_of(const std::vector<Unit>& units, const std::vector<std::size_t>& to_run,
                         const std::string& program) {
  std::map<std::size_t, std::size_t> job_of_unit;
  std::vector<Job> jobs;
  for (const std::size_t i : to_run) {
    Job job{program, units[i].arguments, log_file(units[i]), std::nullopt};
    if (units[i].episode) {
      const auto exploration = job_of_unit.find(units[i].exploration);
      if (exploration != job_of_unit.end()) job.after = exploration->second;
    }
    job_of_unit[i] = jobs.size();
    jobs.push_back(std::move(job));
  }
  return jobs;
}

/// What failed, and how badly.
class Failures {
 public:
  /// Tells of a unit that failed as with this exit code.
  void report(const Unit& unit, int exit_code, const std::string& message) {
    ++count_;
    is_internal_ = is_internal_ || exit_code != static_cast<int>(ExitCode::input_error);
    print_message("unit " + unit.name + " failed: " + message + " (" + log_file(unit).string() +
                  ")");
  }

  /// Throws as the worst of them exited, if any did.
  void throw_if_any(std::size_t units, const fs::path& folder) const {
    if (count_ == 0) return;
    const std::string message = std::to_string(count_) + " of " + std::to_string(units) +
                                " units failed; the tables in " + folder.string() +
                                " hold the rest, the same command tries again";
    if (is_internal_) throw Error(message);
    throw InputError(message);
  }

 private:
  std::size_t count_ = 0;
  bool is_internal_ = false;
};

Failures run_units(const ReproduceOptions& options, const std::vector<Unit>& units) {
  const std::vector<std::size_t> to_run = units_to_run(units);
  for (const std::size_t unit : to_run) prepare(units[unit]);
  const std::vector<Job> jobs = jobs_of(units, to_run, options.program);
  Failures failures;
  Progress progress("reproduce", static_cast<double>(jobs.size()));
  double ended = 0.0;
  const auto on_end = [&](std::size_t job, const JobResult& result) {
    const Unit& unit = units[to_run[job]];
    if (result.status == JobStatus::failed) {
      progress.finish();
      failures.report(unit, result.exit_code, result.message);
    } else if (!is_done(unit)) {
      progress.finish();
      failures.report(unit, static_cast<int>(ExitCode::internal_error),
                      "it ended well, but left no whole summary");
    }
    progress.update(++ended);
  };
  const PoolResult pool = run_jobs(jobs, options.jobs, on_end);
  progress.finish();
  if (pool.stopped_by) end_by(*pool.stopped_by);
  return failures;
}

std::vector<UnitResult> read_results(const std::vector<Unit>& units) {
  std::vector<UnitResult> results(units.size());
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (!is_done(units[i])) continue;
    if (units[i].episode) {
      results[i].episode = read_episode_summary(units[i].summary);
    } else {
      results[i].exploration = read_exploration_summary(units[i].summary);
    }
  }
  return results;
}

void write_tables(const ReproductionTable& table, const fs::path& folder) {
  write_file_atomically(folder / "table.md", to_markdown(table));
  write_file_atomically(folder / "table.csv", to_csv(table.results));
  write_file_atomically(folder / "prediction.csv", to_csv(table.predictions));
  write_file_atomically(folder / "table.json", to_text(to_json(table)));
}

}  // namespace

void reproduce(const ReproduceOptions& options) {
  const std::vector<Unit> units = experiment_units(options.experiment);
  if (options.dry_run) return print_commands(units);
  const fs::path& folder = options.experiment.output_folder;
  create_folder(folder / "units");
  const Failures failures = run_units(options, units);
  const ReproductionTable table = make_table(units, read_results(units));
  write_tables(table, folder);
  print_answer(to_markdown(table));
  failures.throw_if_any(units.size(), folder);
}

}  // namespace nbvopt
