#include "reproduction/reproduction_run.hpp"

#include <map>
#include <utility>

#include "core/file_lock.hpp"
#include "core/folder.hpp"

namespace nbvopt {
namespace {

/// Far above what a unit takes, on a busy machine, too.
constexpr double kUnitTimeout_s = 6.0 * 3600.0;

class Work final : public experiment::Work {
 public:
  explicit Work(std::span<const Unit> units) : units_(units), ids_(fingerprints(units)) {}

  experiment::Unit unit(std::size_t index) override {
    return {ids_[index], to_json(units_[index].simulation)};
  }

  Json record(std::size_t index, const experiment::Outcome& outcome) override {
    return unit_record(units_[index], ids_[index], outcome);
  }

  std::optional<std::size_t> predecessor(std::size_t index) const override {
    return units_[index].is_drive() ? std::nullopt : std::optional(units_[index].drive);
  }

 private:
  std::span<const Unit> units_;
  std::vector<std::string> ids_;
};

}  // namespace

void read_worlds(std::span<Unit> units) {
  std::map<std::filesystem::path, std::string> digests;
  for (Unit& unit : units) {
    WorldSource& world = unit.simulation.world;
    std::string& digest = digests[world.file];
    if (digest.empty()) digest = world_digest(read_world(world));
    world.digest = digest;
  }
}

experiment::RunResult run_reproduction(std::span<const Unit> units,
                                       const ReproductionFolder& folder, experiment::Pool& pool,
                                       const std::function<void(const Json& record)>& on_record) {
  create_folder(folder.units());
  const FileLock lock(folder.records(), "run writes this reproduction");
  experiment::RecordFile records(folder.records());
  const std::vector<UnitResult> results = read_results(units, folder);
  std::vector<std::size_t> to_run;
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (!results[i].is_there()) to_run.push_back(i);
  }
  Work work(units);
  return experiment::run_units(work, to_run, kUnitTimeout_s, pool, records, on_record);
}

}  // namespace nbvopt
