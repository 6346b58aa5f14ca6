// A study's report for people.
#pragma once

#include <string>

#include "study/evaluate/evaluation.hpp"
#include "study/results.hpp"

namespace nbvopt {

/// Markdown that shows the pictures beside it; the same results give the same bytes.
std::string study_text(const study::Results& results, const study::Evaluation& evaluation);

}  // namespace nbvopt
