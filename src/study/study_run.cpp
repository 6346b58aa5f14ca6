#include "study/study_run.hpp"

#include <unordered_map>
#include <utility>
#include <vector>

#include "core/file_lock.hpp"
#include "core/folder.hpp"
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
  create_folder(folder.root);
  const FileLock lock(folder.study(), "run writes this study");
  write_study(study, folder);
  experiment::RecordFile records(record_path(folder, kind));
  Work work(study, folder, kind);
  std::vector<std::size_t> to_do;
  {
    const auto finished = finished_units(record_path(folder, kind));
    for (const std::size_t i : work.of(options.shard)) {
      const auto unit = finished.find(work.id(i));
      if (unit == finished.end() || (unit->second && options.retry_failed)) to_do.push_back(i);
    }
  }
  return experiment::run_units(
      work, to_do, kind == WorkKind::query ? study.unit_timeout_s : study.reference_timeout_s, pool,
      records, on_end);
}

}  // namespace nbvopt::study
