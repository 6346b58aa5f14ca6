#include "reproduction/reproduction_run.hpp"

#include <map>
#include <utility>

#include "core/atomic_file.hpp"
#include "core/file_lock.hpp"
#include "core/folder.hpp"
#include "experiment/exchange.hpp"
#include "sim/world/built_world.hpp"

namespace nbvopt {
namespace {

/// Far above what a unit takes, on a busy machine, too.
constexpr double kUnitTimeout_s = 6.0 * 3600.0;

class Work final : public experiment::Work {
 public:
  explicit Work(std::span<const Unit> units) : units_(units), ids_(fingerprints(units)) {}

  std::string id(std::size_t index) override { return ids_[index]; }

  experiment::Unit unit(std::size_t index) override {
    return {ids_[index], to_json(units_[index].simulation)};
  }

  Json record(std::size_t index, const experiment::Outcome& outcome) override {
    return unit_record(units_[index], ids_[index], outcome);
  }

  std::optional<std::size_t> predecessor(std::size_t index) const override {
    return units_[index].is_drive() ? std::nullopt : std::optional(units_[index].drive);
  }

  experiment::UnitFiles files(std::size_t index) const override {
    const SimulationUnit& simulation = units_[index].simulation;
    experiment::UnitFiles files;
    if (simulation.world.built) files.reads.emplace_back("/world/built");
    (units_[index].is_drive() ? files.writes : files.reads).emplace_back("/trajectory");
    if (!simulation.picture.empty()) files.writes.emplace_back("/picture");
    return files;
  }

 private:
  std::span<const Unit> units_;
  std::vector<std::string> ids_;
};

/// The folder, which is no other run's meanwhile.
FileLock open_folder(const ReproductionFolder& folder) {
  create_folder(folder.units());
  return {folder.records(), "run writes this reproduction"};
}

/// Whether each unit has a result.
std::vector<bool> answered_units(std::span<const Unit> units, const ReproductionFolder& folder) {
  std::vector<bool> answered;
  for (const UnitResult& result : read_results(units, folder)) {
    answered.push_back(result.is_there());
  }
  return answered;
}

std::vector<std::size_t> open_units(std::span<const Unit> units, const ReproductionFolder& folder) {
  const std::vector<bool> answered = answered_units(units, folder);
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (!answered[i]) open.push_back(i);
  }
  return open;
}

/// Reads each world once: visit(world, source) may note more in the source, whose digest is known.
template <class Visit>
void read_each_world(std::span<Unit> units, const Visit& visit) {
  std::map<std::filesystem::path, WorldSource> sources;
  for (Unit& unit : units) {
    WorldSource& source = unit.simulation.world;
    const auto [known, is_new] = sources.try_emplace(source.file, source);
    if (is_new) {
      const World world = read_world(source);
      known->second.digest = world_digest(world);
      visit(world, known->second);
    }
    source = known->second;
  }
}

}  // namespace

void read_worlds(std::span<Unit> units) {
  read_each_world(units, [](const World&, WorldSource&) {});
}

void build_worlds(std::span<Unit> units, const ReproductionFolder& folder) {
  create_folder(folder.worlds());
  read_each_world(units, [&folder](const World& world, WorldSource& source) {
    source.built = folder.worlds() / (source.digest + ".nbvworld");
    write_file_atomically(*source.built, pack_world(world));
  });
}

experiment::RunResult run_reproduction(std::span<const Unit> units,
                                       const ReproductionFolder& folder, experiment::Pool& pool,
                                       const std::function<void(const Json& record)>& on_record,
                                       const std::function<void(std::size_t units)>& on_stop) {
  const FileLock lock = open_folder(folder);
  experiment::RecordFile records(folder.records());
  Work work(units);
  return experiment::run_units(work, open_units(units, folder), kUnitTimeout_s, pool, records,
                               on_record, on_stop);
}

void list_units(std::span<const Unit> units, const ReproductionFolder& folder,
                const std::function<void(const std::string& line)>& visit) {
  const FileLock lock = open_folder(folder);
  Work work(units);
  experiment::list_units(work, open_units(units, folder), kUnitTimeout_s, visit);
}

void record_answers(std::span<const Unit> units, const ReproductionFolder& folder,
                    std::istream& answers,
                    const std::function<void(const std::string& id)>& on_kept) {
  const FileLock lock = open_folder(folder);
  experiment::RecordFile records(folder.records());
  Work work(units);
  experiment::record_answers(work, answered_units(units, folder), records, answers, on_kept);
}

}  // namespace nbvopt
