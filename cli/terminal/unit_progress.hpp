// How far the units of a long run are, and what befalls them, on standard error.
#pragma once

#include <cstddef>
#include <string>

#include "cli/terminal/progress.hpp"

namespace nbvopt {

class UnitProgress {
 public:
  /// Of so many units.
  UnitProgress(const std::string& what, std::size_t total)
      : progress_(what, static_cast<double>(total)) {}

  /// One more has ended.
  void end_unit() { progress_.update(++ended_); }

  void tell_failure(const std::string& unit, const std::string& failure);

  /// A signal stops the run, and so many units are at work.
  void tell_stop(std::size_t units);

  void finish() { progress_.finish(); }

 private:
  Progress progress_;
  double ended_ = 0.0;
};

}  // namespace nbvopt
