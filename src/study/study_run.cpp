#include "study/study_run.hpp"

#include <unordered_map>
#include <utility>

#include "core/file_lock.hpp"
#include "core/folder.hpp"
#include "study/record.hpp"
#include "study/record_file.hpp"

namespace nbvopt::study {
namespace {

/// The units of one kind. A reference is one of a case.
class Work {
 public:
  Work(const Study& study, WorkKind kind) : study_(study), kind_(kind), fingerprints_(study) {}

  std::size_t count() const {
    return kind_ == WorkKind::query ? unit_count(study_) : case_count(study_);
  }

  UnitIndex at(std::size_t index) const {
    return kind_ == WorkKind::query ? unit_at(study_, index) : UnitIndex{.case_index = index};
  }

  std::string id(std::size_t index) {
    return kind_ == WorkKind::query ? fingerprints_.of_unit(at(index))
                                    : fingerprints_.of_case(index);
  }

  WorkUnit unit(std::size_t index, const StudyFolder& folder) {
    const UnitIndex place = at(index);
    const CaseIndex asked = case_at(study_, place.case_index);
    const StudyMap& map = study_.maps[asked.map];
    return {.id = id(index),
            .kind = kind_,
            .map = map.file,
            .map_digest = map.digest,
            .robot = folder.robot(),
            .start = map.starts[asked.start],
            .motion_time_s = study_.motion_times_s[asked.motion_time],
            .mode = study_.modes[asked.mode],
            .search = study_.searches[place.search].search,
            .budget = study_.budgets[place.budget],
            .seed = study_.seeds[place.seed]};
  }

  Json record(std::size_t index, const WorkOutcome& outcome) {
    const UnitIndex place = at(index);
    return kind_ == WorkKind::query
               ? query_record(study_, place, fingerprints_, outcome)
               : reference_record(study_, place.case_index, fingerprints_, outcome);
  }

 private:
  const Study& study_;
  WorkKind kind_;
  Fingerprints fingerprints_;
};

std::filesystem::path record_path(const StudyFolder& folder, WorkKind kind) {
  return kind == WorkKind::query ? folder.records() : folder.references();
}

/// The fingerprints of what has a record, and whether it has failed. A later record wins.
std::unordered_map<std::string, bool> finished_units(const std::filesystem::path& path) {
  std::unordered_map<std::string, bool> finished;
  for_each_record(path, [&finished](const Json& record) {
    finished[record_id(record)] = record.contains("failure");
  });
  return finished;
}

}  // namespace

WorkCount count_work(const Study& study, const StudyFolder& folder, WorkKind kind) {
  const auto finished = finished_units(record_path(folder, kind));
  Work work(study, kind);
  WorkCount count{.total = work.count()};
  for (std::size_t i = 0; i < count.total; ++i) {
    const auto unit = finished.find(work.id(i));
    if (unit == finished.end()) continue;
    ++count.done;
    if (unit->second) ++count.failed;
  }
  return count;
}

CoordinatorResult run_study(const Study& study, const StudyFolder& folder, WorkKind kind,
                            const RunOptions& options,
                            const std::function<void(const Json& record)>& on_end) {
  create_folder(folder.root);
  const FileLock lock(folder.study(), "run writes this study");
  write_study(study, folder);
  RecordFile records(record_path(folder, kind));
  Work work(study, kind);
  std::vector<std::size_t> to_do;
  {
    const auto finished = finished_units(record_path(folder, kind));
    for (std::size_t i = 0; i < work.count(); ++i) {
      const auto unit = finished.find(work.id(i));
      if (unit == finished.end() || (unit->second && options.retry_failed)) to_do.push_back(i);
    }
  }
  const CoordinatorOptions coordination{
      .worker_command = options.worker_command,
      .workers = options.workers,
      .timeout_s = kind == WorkKind::query ? study.unit_timeout_s : study.reference_timeout_s};
  return run_units(
      to_do.size(), [&](std::size_t i) { return work.unit(to_do[i], folder); }, coordination,
      [&](std::size_t i, const WorkOutcome& outcome) {
        const Json record = work.record(to_do[i], outcome);
        records.append(record);
        on_end(record);
      });
}

}  // namespace nbvopt::study
