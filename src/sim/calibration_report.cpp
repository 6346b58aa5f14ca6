#include "sim/calibration_report.hpp"

#include "core/number.hpp"
#include "nbvopt/gain/hazard_file.hpp"
#include "sim/episode_output.hpp"

namespace nbvopt {
namespace {

Json to_json(const PredictionRecord& record) {
  return {{"steps", record.steps},
          {"bias", number_or_null(record.bias())},
          {"correlation", number_or_null(record.correlation())},
          {"slope", number_or_null(record.slope())}};
}

Json to_json(const PredictionJudgement& judgement) {
  return {{"chosen", to_json(judgement.chosen)},
          {"random", to_json(judgement.random)},
          {"regret", judgement.regret()},
          {"information", judgement.information}};
}

std::string figures(const PredictionRecord& record) {
  return "bias " + decimal(100.0 * record.bias(), 0) + " %, correlation " +
         decimal(record.correlation(), 3) + ", slope " + decimal(record.slope(), 2);
}

std::string line(const std::string& context, double hazard_per_m, double metres) {
  return "  " + context + ": " + decimal(hazard_per_m, 3) + " (" + decimal(metres, 0) + " m)\n";
}

std::string to_text(const std::string& began_with, const PredictionJudgement& judgement) {
  return "  " + began_with + ": chosen views " + figures(judgement.chosen) + "; random views " +
         figures(judgement.random) + "; regret " + decimal(100.0 * judgement.regret(), 1) +
         " %; information " + decimal(judgement.information, 0) + '\n';
}

}  // namespace

Json to_json(const Calibration& calibration) {
  Json drives = Json::array();
  for (const DriveCalibration& drive : calibration.drives) {
    drives.push_back({{"world", drive.world},
                      {"learnt", Json::parse(hazards_json(drive.learnt))},
                      {"from_nothing", to_json(drive.from_nothing)},
                      {"left_out", to_json(drive.left_out)}});
  }
  return {{"hazards", Json::parse(hazards_json(calibration.hazards))}, {"drives", drives}};
}

std::string to_text(const Calibration& calibration) {
  std::string text;
  for (const DriveCalibration& drive : calibration.drives) {
    text += drive.world + '\n' + to_text("from nothing", drive.from_nothing) +
            to_text("from the other worlds", drive.left_out);
  }
  text += "hits a metre over all drives:\n";
  const std::vector<std::string> names = hazard_context_names();
  for (std::size_t c = 0; c < names.size(); ++c) {
    double metres = 0.0;
    for (const DriveCalibration& drive : calibration.drives) metres += drive.learnt.count(c).metres;
    text += line(names[c], calibration.hazards.hazard_per_m(c), metres);
  }
  return text;
}

std::string to_text(const HazardTable& hazards) {
  std::string text = "hits a metre, prior included:\n";
  const std::vector<std::string> names = hazard_context_names();
  for (std::size_t c = 0; c < names.size(); ++c) {
    text += line(names[c], hazards.hazard_per_m(c), hazards.count(c).metres);
  }
  return text;
}

}  // namespace nbvopt
