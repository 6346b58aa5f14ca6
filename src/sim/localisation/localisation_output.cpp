#include "sim/localisation/localisation_output.hpp"

#include <cstdint>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"
#include "sim/localisation/pose_source_names.hpp"

namespace nbvopt {
namespace {

Json to_json(const PositionError& error) {
  return {{"mean", error.mean_m}, {"largest", error.largest_m}, {"end", error.end_m}};
}

PositionError position_error_of(const Json& json) {
  return {.mean_m = json.at("mean").get<double>(),
          .largest_m = json.at("largest").get<double>(),
          .end_m = json.at("end").get<double>()};
}

std::string to_text(const PositionError& error) {
  return decimal(error.mean_m, 3) + " m on average, " + decimal(error.largest_m, 3) +
         " m at most, " + decimal(error.end_m, 3) + " m in the end";
}

}  // namespace

std::string to_string(PoseSource source) { return std::string(enum_name(source)); }

PoseSource pose_source_of(const std::string& name) {
  const auto source = enum_value<PoseSource>(name);
  if (!source) throw InputError("there is no pose source '" + name + "': give truth, odom or slam");
  return *source;
}

Json to_json(const LocalisationRecord& record) {
  return {{"position_error_m", to_json(record.captures)},
          {"position_error_after_scans_m", to_json(record.scans)},
          {"scans", record.scan_count}};
}

LocalisationRecord localisation_record_of(const Json& json, double scan_ms) {
  return {.captures = position_error_of(json.at("position_error_m")),
          .scans = position_error_of(json.at("position_error_after_scans_m")),
          .scan_count = json.at("scans").get<std::uint64_t>(),
          .scan_ms = scan_ms};
}

Json to_json(const MapScore& score) {
  return {{"occupied_voxels", score.occupied_voxels},
          {"precision", score.precision},
          {"recall", score.recall},
          {"true_information", score.true_information},
          {"shared_information", score.shared_information}};
}

MapScore map_score_of(const Json& json) {
  return {.occupied_voxels = json.at("occupied_voxels").get<std::uint64_t>(),
          .precision = json.at("precision").get<double>(),
          .recall = json.at("recall").get<double>(),
          .true_information = json.at("true_information").get<double>(),
          .shared_information = json.at("shared_information").get<double>()};
}

std::string to_text(const LocalisationRecord& record, PoseSource source) {
  std::string text = "pose by " + to_string(source) + ": off by " + to_text(record.captures);
  if (record.scan_count > 0) {
    text += "; after each of " + std::to_string(record.scan_count) + " scans, which took " +
            decimal(record.scan_ms, 1) + " ms, by " + to_text(record.scans);
  }
  return text + '\n';
}

std::string to_text(const MapScore& score) {
  return "truth: " + decimal(100.0 * score.precision, 1) +
         " % of the occupied voxels are at a surface (precision), " +
         decimal(100.0 * score.recall, 1) +
         " % of what the views showed is in the map (recall), information of true voxels " +
         decimal(score.true_information, 1) + ", of voxels that true poses give, too, " +
         decimal(score.shared_information, 1) + '\n';
}

}  // namespace nbvopt
