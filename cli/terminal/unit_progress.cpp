#include "cli/terminal/unit_progress.hpp"

#include "cli/terminal/output.hpp"

namespace nbvopt {

void UnitProgress::tell_failure(const std::string& unit, const std::string& failure) {
  progress_.finish();
  print_message("unit " + unit + " failed: " + failure);
}

void UnitProgress::tell_stop(std::size_t units) {
  progress_.finish();
  print_message("stopping when what is at work has ended, " + std::to_string(units) +
                (units == 1 ? " unit" : " units") + "; Ctrl-C once more drops it");
}

}  // namespace nbvopt
