#include "study/study_run.hpp"

#include <unordered_map>
#include <utility>
#include <vector>

#include "core/file_lock.hpp"
#include "core/folder.hpp"
#include "experiment/exchange.hpp"
#include "experiment/record_file.hpp"
#include "study/fingerprints.hpp"
#include "study/record.hpp"

namespace nbvopt::study {
namespace {

/// The units of one kind. A reference is one of a case.
class Work final : public experiment::Work {
 public:
  Work(const Study& study, const StudyFolder& folder, WorkKind kind)
      : study_(study), folder_(folder), kind_(kind), fingerprints_(study) {}

  std::size_t size() const {
    return kind_ == WorkKind::query ? unit_count(study_) : case_count(study_);
  }

  double timeout_s() const {
    return kind_ == WorkKind::query ? study_.unit_timeout_s : study_.reference_timeout_s;
  }

  /// The units of a shard, ascending.
  std::vector<std::size_t> of(const Shard& shard) const {
    std::vector<std::size_t> units;
    for (std::size_t i = 0; i < size(); ++i) {
      if (shard.has(at(i).case_index)) units.push_back(i);
    }
    return units;
  }

  std::string id(std::size_t index) override {
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

  experiment::UnitFiles files(std::size_t /*index*/) const override {
    return {.reads = {"/map", "/robot"}, .writes = {}};
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
                                const std::function<void(const Json& record)>& on_end,
                                const std::function<void(std::size_t units)>& on_stop) {
  const FileLock lock = open_folder(study, folder);
  experiment::RecordFile records(record_path(folder, kind));
  Work work(study, folder, kind);
  const std::vector<std::size_t> to_do = open_units(work, record_path(folder, kind), options);
  return experiment::run_units(work, to_do, work.timeout_s(), pool, records, on_end, on_stop);
}

void list_units(const Study& study, const StudyFolder& folder, WorkKind kind,
                const RunOptions& options,
                const std::function<void(const std::string& line)>& visit) {
  const FileLock lock = open_folder(study, folder);
  Work work(study, folder, kind);
  const std::vector<std::size_t> to_do = open_units(work, record_path(folder, kind), options);
  experiment::list_units(work, to_do, work.timeout_s(), visit);
}

void record_answers(const Study& study, const StudyFolder& folder, WorkKind kind,
                    std::istream& answers,
                    const std::function<void(const std::string& id)>& on_kept) {
  const FileLock lock = open_folder(study, folder);
  experiment::RecordFile records(record_path(folder, kind));
  Work work(study, folder, kind);
  std::vector<bool> has_answer(work.size(), true);
  for (const std::size_t i : open_units(work, record_path(folder, kind), {.retry_failed = true})) {
    has_answer[i] = false;
  }
  experiment::record_answers(work, std::move(has_answer), records, answers, on_kept);
}

}  // namespace nbvopt::study
