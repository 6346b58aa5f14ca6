// What a page shows of a robot and an answer, as JSON: transforms column by column, as WebGL takes
// them.
#pragma once

#include "core/json.hpp"
#include "nbvopt/mast/mast.hpp"
#include "nbvopt/planner/plan.hpp"
#include "nbvopt/sensor/sensor_options.hpp"
#include "web/answer_file.hpp"

namespace nbvopt {

/// What a camera sees.
Json camera_json(const SensorOptions& sensor);

/// Where a mast's pan axis stands on the base.
Json mast_json(const MastOptions& mast);

/// The view that the robot has, and the chosen one.
Json answer_json(const AnswerFile& answer, const Mast& mast);

/// An answer as its file would have it.
AnswerFile answer_of(const PlanResult& result);

}  // namespace nbvopt
