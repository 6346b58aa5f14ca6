#include "study/study_run.hpp"

#include <unordered_map>
#include <utility>
#include <vector>

#include "core/file_lock.hpp"
#include "core/folder.hpp"
#include "experiment/protocol.hpp"
#include "experiment/record_file.hpp"
#include "nbvopt/core/error.hpp"
#include "study/fingerprints.hpp"
#include "study/record.hpp"

namespace nbvopt::study {
namespace {

/// The units of one kind. A reference is one of a case.
class Work final : public experiment::Work {
 public:
  Work(const Study& study, const StudyFolder& folder, WorkKind kind)
      : study_(study), folder_(folder), kind_(kind), fingerprints_(study) {}

  /// The units of a shard, ascending.
  std::vector<std::size_t> of(const Shard& shard) const {
    const std::size_t count = kind_ == WorkKind::query ? unit_count(study_) : case_count(study_);
    std::vector<std::size_t> units;
    for (std::size_t i = 0; i < count; ++i) {
      if (shard.has(at(i).case_index)) units.push_back(i);
    }
    return units;
  }

  std::string id(std::size_t index) {
    return kind_ == WorkKind::query ? fingerprints_.of_unit(at(index))
                                    : fingerprints_.of_case(index);
  }

  experiment::Unit unit(std::size_t index) override {
    const UnitIndex place = at(index);
    const CaseIndex asked = case_at(study_, place.case_index);
    const StudyMap& map = study_.maps[asked.map];
    return message_of({.id = id(index),
                       .kind = kind_,
                       .map = map.file,
                       .map_digest = map.digest,
                       .robot = folder_.robot(),
                       .start = map.starts[asked.start],
                       .motion_time_s = study_.motion_times_s[asked.motion_time],
                       .mode = study_.modes[asked.mode],
                       .search = study_.searches[place.search].search,
                       .budget = study_.budgets[place.budget],
                       .seed = study_.seeds[place.seed]});
  }

  Json record(std::size_t index, const experiment::Outcome& outcome) override {
    const UnitIndex place = at(index);
    return kind_ == WorkKind::query
               ? query_record(study_, place, fingerprints_, outcome)
               : reference_record(study_, place.case_index, fingerprints_, outcome);
  }

 private:
  UnitIndex at(std::size_t index) const {
    return kind_ == WorkKind::query ? unit_at(study_, index) : UnitIndex{.case_index = index};
  }

  const Study& study_;
  const StudyFolder& folder_;
  WorkKind kind_;
  Fingerprints fingerprints_;
};

std::filesystem::path record_path(const StudyFolder& folder, WorkKind kind) {
  return kind == WorkKind::query ? folder.records() : folder.references();
}

/// The fingerprints of what has a record, and whether it has failed. A later record wins.
std::unordered_map<std::string, bool> finished_units(const std::filesystem::path& path) {
  std::unordered_map<std::string, bool> finished;
  experiment::for_each_record(path, [&finished](const Json& record) {
    finished[record_id(record)] = record.contains("failure");
  });
  return finished;
}

/// The units of the shard that are to be run.
std::vector<std::size_t> open_units(Work& work, const std::filesystem::path& records,
                                    const RunOptions& options) {
  const auto finished = finished_units(records);
  std::vector<std::size_t> open;
  for (const std::size_t i : work.of(options.shard)) {
    const auto unit = finished.find(work.id(i));
    if (unit == finished.end() || (unit->second && options.retry_failed)) open.push_back(i);
  }
  return open;
}

/// The study in its folder, which is no other run's meanwhile.
FileLock open_folder(const Study& study, const StudyFolder& folder) {
  create_folder(folder.root);
  FileLock lock(folder.study(), "run writes this study");
  write_study(study, folder);
  return lock;
}

}  // namespace

WorkCount count_work(const Study& study, const StudyFolder& folder, WorkKind kind,
                     const Shard& shard) {
  const auto finished = finished_units(record_path(folder, kind));
  Work work(study, folder, kind);
  const std::vector<std::size_t> units = work.of(shard);
  WorkCount count{.total = units.size()};
  for (const std::size_t i : units) {
    const auto unit = finished.find(work.id(i));
    if (unit == finished.end()) continue;
    ++count.done;
    if (unit->second) ++count.failed;
  }
  return count;
}

experiment::RunResult run_study(const Study& study, const StudyFolder& folder, WorkKind kind,
                                const RunOptions& options, experiment::Pool& pool,
                                const std::function<void(const Json& record)>& on_end) {
  const FileLock lock = open_folder(study, folder);
  experiment::RecordFile records(record_path(folder, kind));
  Work work(study, folder, kind);
  const std::vector<std::size_t> to_do = open_units(work, record_path(folder, kind), options);
  return experiment::run_units(
      work, to_do, kind == WorkKind::query ? study.unit_timeout_s : study.reference_timeout_s, pool,
      records, on_end);
}

void list_units(const Study& study, const StudyFolder& folder, WorkKind kind,
                const RunOptions& options,
                const std::function<void(const experiment::Unit& unit)>& visit) {
  const FileLock lock = open_folder(study, folder);
  Work work(study, folder, kind);
  for (const std::size_t i : open_units(work, record_path(folder, kind), options)) {
    visit(work.unit(i));
  }
}

std::size_t record_answers(const Study& study, const StudyFolder& folder, WorkKind kind,
                           std::istream& answers) {
  const FileLock lock = open_folder(study, folder);
  experiment::RecordFile records(record_path(folder, kind));
  Work work(study, folder, kind);
  std::unordered_map<std::string, std::size_t> unit_of_id;
  for (const std::size_t i : work.of({})) unit_of_id.emplace(work.id(i), i);
  auto finished = finished_units(record_path(folder, kind));
  std::size_t count = 0;
  std::string line;
  for (std::size_t number = 1; std::getline(answers, line); ++number) {
    const std::string id = experiment::unit_of_answer(line);
    const auto unit = unit_of_id.find(id);
    const auto outcome = experiment::parse_answer(line, id);
    if (unit == unit_of_id.end() || !outcome) {
      throw InputError("answers: line " + std::to_string(number) +
                       ": is no answer to a unit of this study: " + line.substr(0, 80));
    }
    const auto known = finished.find(id);
    if (known != finished.end() && !known->second) continue;
    records.append(work.record(unit->second, *outcome));
    finished[id] = !outcome->failure.empty();
    ++count;
  }
  return count;
}

}  // namespace nbvopt::study
