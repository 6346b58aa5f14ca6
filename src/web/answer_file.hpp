// An answer of `nbvopt query --json`, read again.
#pragma once

#include <string>

#include "nbvopt/planner/plan.hpp"

namespace nbvopt {

/// An answer, and the question that it answers.
struct AnswerFile {
  PlanRequest request;
  JointPosition joints;       ///< where to move
  double gain = 0.0;          ///< of the view there
  double current_gain = 0.0;  ///< of staying
  std::string why;            ///< how the search ended, in words
};

/// Reads the object from its text; `name` stands for the file in messages. Throws InputError that
/// names the file and the key where it is no JSON, or a key is missing, of another type or not
/// finite.
AnswerFile parse_answer_file(const std::string& json, const std::string& name);

}  // namespace nbvopt
