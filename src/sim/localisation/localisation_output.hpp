// What localisation and scores of maps leave behind, for programs and for people.
#pragma once

#include <string>

#include "core/json.hpp"
#include "nbvopt/sim/localisation.hpp"
#include "nbvopt/sim/map_score.hpp"

namespace nbvopt {

std::string to_string(PoseSource source);
/// Without the computing time of a scan, which is no outcome.
Json to_json(const LocalisationRecord& record);
Json to_json(const MapScore& score);

/// A line for people.
std::string to_text(const LocalisationRecord& record, PoseSource source);
std::string to_text(const MapScore& score);

/// The way back. Throw nlohmann's exceptions, and InputError for a source that is not known.
PoseSource pose_source_of(const std::string& name);
LocalisationRecord localisation_record_of(const Json& json, double scan_ms);
MapScore map_score_of(const Json& json);

}  // namespace nbvopt
