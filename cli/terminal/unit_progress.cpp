#include "cli/terminal/unit_progress.hpp"

#include "cli/terminal/output.hpp"

namespace nbvopt {

void UnitProgress::end_unit(const Json& record) {
  if (record.contains("failure")) {
    progress_.finish();
    print_message("unit " + name_of_(record) +
                  " failed: " + record.at("failure").get<std::string>());
  }
  progress_.update(++ended_);
}

void UnitProgress::tell_stop(std::size_t units) {
  progress_.finish();
  print_message("stopping when what is at work has ended, " + std::to_string(units) +
                (units == 1 ? " unit" : " units") + "; Ctrl-C once more drops it");
}

}  // namespace nbvopt
