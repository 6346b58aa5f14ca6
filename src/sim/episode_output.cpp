#include "sim/episode_output.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <system_error>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"
#include "sim/localisation/localisation_output.hpp"

namespace nbvopt {
namespace {

ExplorationStatus status_of(const std::string& name) {
  for (const auto status : {ExplorationStatus::complete, ExplorationStatus::open_ground,
                            ExplorationStatus::time_limit}) {
    if (name == to_string(status)) return status;
  }
  throw InputError("the status '" + name + "' of a drive is not known");
}

/// None where it was not told.
std::optional<ExplorationStatus> drive_status_of(const Json& json) {
  const auto status = json.find("drive_status");
  if (status == json.end() || status->is_null()) return std::nullopt;
  return status_of(status->get<std::string>());
}

Json count_or_null(const std::optional<std::uint64_t>& count) {
  return count ? Json(*count) : Json(nullptr);
}

std::optional<std::uint64_t> count_if_any(const Json& json) {
  return json.is_null() ? std::nullopt : std::optional(json.get<std::uint64_t>());
}

std::string percent(double share) { return decimal(100.0 * share, 0) + " %"; }

constexpr std::size_t kGrowthPoints = 200;  ///< of a report: steps of half a percent

Json to_json(const InformationGrowth& growth) {
  Json time_s = Json::array();
  Json information = Json::array();
  const InformationGrowth thin = growth.thinned(kGrowthPoints);
  for (const InformationGrowth::Point& point : thin.points()) {
    time_s.push_back(point.time_s);
    information.push_back(point.information);
  }
  return {{"time_s", time_s}, {"information", information}};
}

InformationGrowth growth_of(const Json& json) {
  const auto time_s = json.at("time_s").get<std::vector<double>>();
  const auto information = json.at("information").get<std::vector<double>>();
  InformationGrowth growth;
  for (std::size_t i = 0; i < std::min(time_s.size(), information.size()); ++i) {
    growth.add(time_s[i], information[i]);
  }
  return growth;
}

template <class Value>
Json json_or_null(const std::optional<Value>& value) {
  return value ? to_json(*value) : Json(nullptr);
}

/// The value of a key that may be null.
template <class Read>
auto optional_of(const Json& json, const char* key, const Read& read)
    -> std::optional<decltype(read(json))> {
  const Json& value = json.at(key);
  if (value.is_null()) return std::nullopt;
  return read(value);
}

/// When half of the final map was there, and more of it.
std::string growth_text(const EpisodeSummary& summary) {
  std::string text = "growth: " + decimal(summary.growth.mean_until(summary.duration_s), 1) +
                     " information on average over the drive";
  for (const double share : {0.5, 0.8, 0.9}) {
    const auto time_s = summary.growth.time_to_s(share * summary.information);
    if (time_s) text += ", " + percent(share) + " after " + decimal(*time_s, 1) + " s";
  }
  return text + '\n';
}

/// x, y, z and yaw.
Json base_json(const Transform& T_map_base) {
  const Eigen::Vector3d& base_m = T_map_base.translation();
  const Eigen::Vector3d x_map = T_map_base.linear().col(0);
  return {base_m.x(), base_m.y(), base_m.z(), std::atan2(x_map.y(), x_map.x())};
}

}  // namespace

void StepTimer::add(const Capture& capture) {
  sum_.render_ms += capture.render_ms;
  sum_.insert_ms += capture.insert_ms;
  sum_.grid_ms += capture.grid_ms;
  sum_.plan_ms += capture.plan_ms;
  ++captures_;
}

StepTimes StepTimer::mean() const {
  if (captures_ == 0) return {};
  const auto n = static_cast<double>(captures_);
  return {sum_.render_ms / n, sum_.insert_ms / n, sum_.grid_ms / n, sum_.plan_ms / n};
}

Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json to_json(const Capture& capture) {
  return {{"frame", capture.frame},
          {"time_s", capture.time_s},
          {"base", base_json(capture.T_map_base)},
          {"true_base", base_json(capture.T_world_base)},
          {"pan", capture.joints.pan_rad},
          {"tilt", capture.joints.tilt_rad},
          {"height", capture.joints.height_m},
          {"is_on_the_way", capture.is_on_the_way},
          {"points_used", capture.points_used},
          {"voxels", capture.voxels},
          {"information", capture.information},
          {"information_gain", capture.information_gain},
          {"ghosts", count_or_null(capture.ghosts)},
          {"predicted_gain", number_or_null(capture.predicted_gain)},
          {"realised_gain", number_or_null(capture.realised_gain)},
          {"motion_time_s", capture.motion_time_s},
          {"render_ms", capture.render_ms},
          {"insert_ms", capture.insert_ms},
          {"grid_ms", capture.grid_ms},
          {"plan_ms", capture.plan_ms}};
}

Json to_json(const DriveReport& report) {
  return {{"world", report.world},
          {"start", report.start},
          {"status", to_string(report.status)},
          {"duration_s", report.duration_s},
          {"length_m", report.length_m},
          {"seed", report.seed}};
}

DriveReport drive_report_of(const Json& json) {
  return {.world = json.at("world").get<std::string>(),
          .start = json.at("start").get<std::vector<double>>(),
          .status = status_of(json.at("status").get<std::string>()),
          .duration_s = json.at("duration_s").get<double>(),
          .length_m = json.at("length_m").get<double>(),
          .seed = json.at("seed").get<std::uint64_t>()};
}

std::string to_text(const DriveReport& report) {
  return std::string("exploration ") + to_string(report.status) + ": " +
         decimal(report.length_m, 1) + " m in " + decimal(report.duration_s, 1) + " s\n";
}

Json to_json(const EpisodeReport& report) {
  const EpisodeSummary& summary = report.summary;
  const PredictionRecord& prediction = summary.prediction;
  return {
      {"world", report.world},
      {"mode", report.mode},
      {"motion_time_s", report.motion_time_s},
      {"seed", report.seed},
      {"drive_status", report.drive_status ? Json(to_string(*report.drive_status)) : Json(nullptr)},
      {"duration_s", summary.duration_s},
      {"captures", summary.captures},
      {"voxels", summary.voxels},
      {"information", summary.information},
      {"ghosts", count_or_null(summary.ghosts)},
      {"mean_information", summary.growth.mean_until(summary.duration_s)},
      {"growth", to_json(summary.growth)},
      {"voxels_as_paper_counts", report.paper_counts.voxels},
      {"information_as_paper_counts", report.paper_counts.information},
      {"pose_source", to_string(report.pose_source)},
      {"localisation", json_or_null(summary.localisation)},
      {"map_score", json_or_null(summary.map_score)},
      {"prediction",
       {{"steps", prediction.steps},
        {"correlation", number_or_null(prediction.correlation())},
        {"predicted_sum", prediction.sum_x},
        {"realised_sum", prediction.sum_y},
        {"bias", number_or_null(prediction.bias())},
        {"pooled",
         {{"sum_x", prediction.sum_x},
          {"sum_y", prediction.sum_y},
          {"sum_xx", prediction.sum_xx},
          {"sum_yy", prediction.sum_yy},
          {"sum_xy", prediction.sum_xy}}}}},
      {"times_ms",
       {{"render", report.times.render_ms},
        {"insert", report.times.insert_ms},
        {"grid", report.times.grid_ms},
        {"plan", report.times.plan_ms},
        {"scan", summary.localisation ? summary.localisation->scan_ms : 0.0},
        {"episode", report.elapsed_ms}}}};
}

EpisodeReport episode_report_of(const Json& json) {
  const Json& prediction = json.at("prediction");
  const Json& pooled = prediction.at("pooled");
  const Json& times_ms = json.at("times_ms");
  const auto number = [](const Json& object, const char* key) {
    return object.at(key).get<double>();
  };
  const auto count = [](const Json& object, const char* key) {
    return object.at(key).get<std::uint64_t>();
  };
  const auto localisation = [&](const Json& record) {
    return localisation_record_of(record, number(times_ms, "scan"));
  };
  return {.world = json.at("world").get<std::string>(),
          .mode = json.at("mode").get<std::string>(),
          .motion_time_s = number(json, "motion_time_s"),
          .seed = count(json, "seed"),
          .summary = {.duration_s = number(json, "duration_s"),
                      .captures = count(json, "captures"),
                      .voxels = count(json, "voxels"),
                      .information = number(json, "information"),
                      .ghosts = count_if_any(json.at("ghosts")),
                      .growth = growth_of(json.at("growth")),
                      .prediction = {.steps = count(prediction, "steps"),
                                     .sum_x = number(pooled, "sum_x"),
                                     .sum_y = number(pooled, "sum_y"),
                                     .sum_xx = number(pooled, "sum_xx"),
                                     .sum_yy = number(pooled, "sum_yy"),
                                     .sum_xy = number(pooled, "sum_xy")},
                      .localisation = optional_of(json, "localisation", localisation),
                      .map_score = optional_of(json, "map_score", map_score_of)},
          .paper_counts = {.voxels = count(json, "voxels_as_paper_counts"),
                           .information = number(json, "information_as_paper_counts")},
          .times = {.render_ms = number(times_ms, "render"),
                    .insert_ms = number(times_ms, "insert"),
                    .grid_ms = number(times_ms, "grid"),
                    .plan_ms = number(times_ms, "plan")},
          .elapsed_ms = number(times_ms, "episode"),
          .drive_status = drive_status_of(json),
          .pose_source = pose_source_of(json.at("pose_source").get<std::string>())};
}

std::string to_text(const EpisodeReport& report) {
  const EpisodeSummary& summary = report.summary;
  const PredictionRecord& prediction = summary.prediction;
  std::string text =
      report.mode + ", t = " + decimal(report.motion_time_s, 2) +
      " s: " + std::to_string(summary.captures) + " captures in " + decimal(summary.duration_s, 1) +
      " s of driving\n" + "map: " + std::to_string(summary.voxels) +
      " voxels with u < 1, information " + decimal(summary.information, 1) + "\n" +
      growth_text(summary) +
      (summary.localisation ? to_text(*summary.localisation, report.pose_source) : "") +
      (summary.map_score ? to_text(*summary.map_score) : "");
  if (summary.ghosts) {
    text += "ghosts: " + std::to_string(*summary.ghosts) +
            " occupied voxels where the static world has nothing\n";
  }
  if (std::isfinite(prediction.correlation())) {
    text += "gain: predicted " + decimal(prediction.sum_x, 0) + ", realised " +
            decimal(prediction.sum_y, 0) + " (bias " + percent(prediction.bias()) +
            "), correlation " + decimal(prediction.correlation(), 3) + "\n";
  }
  const StepTimes& times = report.times;
  return text + "computing: " + decimal(1e-3 * report.elapsed_ms, 1) + " s, " +
         decimal(1e3 * summary.duration_s / report.elapsed_ms, 1) +
         " times faster than real time; a capture " + decimal(times.render_ms, 1) +
         " ms to render, " + decimal(times.insert_ms, 1) + " to insert, " +
         decimal(times.grid_ms, 1) + " for the grid, " + decimal(times.plan_ms, 1) + " to plan\n";
}

CaptureLog::CaptureLog(const std::string& path)
    : path_(path), out_(path, std::ios::binary | std::ios::trunc) {
  if (!out_) {
    throw InputError(path + ": cannot be written: " + std::generic_category().message(errno));
  }
}

void CaptureLog::add(const Capture& capture) {
  out_ << to_json(capture).dump() << '\n' << std::flush;
  if (!out_) {
    throw InputError(path_ + ": cannot be written: " + std::generic_category().message(errno));
  }
}

}  // namespace nbvopt
