#include "study/fingerprints.hpp"

#include "experiment/digest.hpp"
#include "nbvopt/core/version.hpp"
#include "study/unit_message.hpp"

namespace nbvopt::study {

Fingerprints::Fingerprints(const Study& study)
    : study_(study), robot_(experiment::digest(version() + to_yaml(study.robot))) {}

const std::string& Fingerprints::of_case(std::size_t case_index) {
  if (last_case_ == case_index) return last_;
  const CaseIndex place = case_at(study_, case_index);
  const StudyMap& map = study_.maps[place.map];
  const Json identity{{"map", map.digest},
                      {"robot", robot_},
                      {"start", to_json(map.starts[place.start])},
                      {"motion_time_s", study_.motion_times_s[place.motion_time]},
                      {"uncertainty_mode", to_string(study_.modes[place.mode])}};
  last_ = experiment::digest(identity.dump());
  last_case_ = case_index;
  return last_;
}

std::string Fingerprints::of_unit(const UnitIndex& unit) {
  const Json identity{{"case", of_case(unit.case_index)},
                      {"search", to_json(study_.searches[unit.search].search)},
                      {"budget", to_json(study_.budgets[unit.budget])},
                      {"seed", study_.seeds[unit.seed]}};
  return experiment::digest(identity.dump());
}

}  // namespace nbvopt::study
