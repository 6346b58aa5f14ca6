// Stands in for study.cpp and reproduce.cpp in a program without experiments.
#include "cli/left_out.hpp"
#include "cli/reproduce.hpp"
#include "cli/study.hpp"

namespace nbvopt {

void set_up_study(CLI::App& app) { add_left_out(app, "study", "STUDY"); }

void set_up_reproduce(CLI::App& app) { add_left_out(app, "reproduce", "STUDY"); }

}  // namespace nbvopt
