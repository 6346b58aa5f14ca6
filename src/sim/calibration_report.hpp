// What a calibration came to, for programs and for people.
#pragma once

#include <string>

#include "core/json.hpp"
#include "sim/calibration.hpp"

namespace nbvopt {

Json to_json(const Calibration& calibration);
std::string to_text(const Calibration& calibration);

/// A table alone: of each context the hazard and over how many metres, prior included.
std::string to_text(const HazardTable& hazards);

}  // namespace nbvopt
