#include "reproduction/record.hpp"

#include <unordered_map>
#include <variant>

#include "experiment/digest.hpp"
#include "experiment/record_file.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

/// The version of the records' schema.
constexpr int kRecordVersion = 1;

UnitResult result_of(const Json& record, const Unit& unit) {
  UnitResult result;
  if (record.contains("failure")) return result;
  if (unit.is_drive()) {
    result.drive = drive_report_of(record);
  } else {
    result.episode = episode_report_of(record);
  }
  result.trajectory_digest = record.at("trajectory_digest").get<std::string>();
  return result;
}

/// Whether the file is what the drive recorded.
bool has_trajectory(const Unit& unit, const std::string& digest) {
  try {
    return experiment::file_digest(unit.simulation.trajectory) == digest;
  } catch (const InputError&) {
    return false;  // missing
  }
}

}  // namespace

std::vector<std::string> fingerprints(std::span<const Unit> units,
                                      const std::string& program_version) {
  std::vector<std::string> all;
  for (const Unit& unit : units) {
    const Json setting = setting_json(unit.simulation);
    const Json identity = unit.is_drive() ? Json{{"version", program_version},
                                                 {"world", unit.simulation.world.digest},
                                                 {"seed", unit.simulation.seed},
                                                 {"setting", setting}}
                                          : Json{{"drive", all[unit.drive]}, {"setting", setting}};
    all.push_back(experiment::digest(identity.dump()));
  }
  return all;
}

Json unit_record(const Unit& unit, const std::string& fingerprint,
                 const experiment::Outcome& outcome) {
  Json record{{"schema", kRecordVersion}, {"unit", fingerprint}, {"name", unit.name}};
  if (outcome.failure.empty()) {
    record.update(outcome.answer);
  } else {
    record["failure"] = outcome.failure;
  }
  return record;
}

std::string record_id(const Json& record) {
  if (record.at("schema") != kRecordVersion) {
    throw InputError("a record has schema " + record.at("schema").dump() + ", this program reads " +
                     std::to_string(kRecordVersion));
  }
  return record.at("unit").get<std::string>();
}

std::vector<UnitResult> read_results(std::span<const Unit> units,
                                     const ReproductionFolder& folder) {
  std::unordered_map<std::string, std::size_t> unit_of_id;
  for (const std::string& id : fingerprints(units)) unit_of_id.emplace(id, unit_of_id.size());
  std::vector<UnitResult> results(units.size());
  experiment::for_each_record(folder.records(), [&](const Json& record) {
    const auto known = unit_of_id.find(record_id(record));
    if (known == unit_of_id.end()) return;
    results[known->second] = result_of(record, units[known->second]);
  });
  for (std::size_t i = 0; i < units.size(); ++i) {
    UnitResult& result = results[i];
    if (!result.is_there()) continue;
    const bool is_valid =
        units[i].is_drive() ? has_trajectory(units[i], result.trajectory_digest)
                            : result.trajectory_digest == results[units[i].drive].trajectory_digest;
    if (!is_valid) result = {};
  }
  return results;
}

}  // namespace nbvopt
