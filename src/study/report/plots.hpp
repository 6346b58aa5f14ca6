// The pictures of a study's report, each the bytes of a PNG file.
#pragma once

#include <string>

#include "study/evaluate/evaluation.hpp"
#include "study/results.hpp"

namespace nbvopt {

std::string performance_profile_plot(const study::Results& results,
                                     const study::Evaluation& evaluation);
std::string data_profile_plot(const study::Results& results, const study::Evaluation& evaluation);
std::string budget_plot(const study::Results& results, const study::Evaluation& evaluation);
std::string cycle_plot(const study::Results& results, const study::Evaluation& evaluation);

}  // namespace nbvopt
