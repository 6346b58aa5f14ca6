// How far the units of a long run are, and what befalls them, on standard error.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <utility>

#include "cli/terminal/progress.hpp"
#include "core/json.hpp"

namespace nbvopt {

class UnitProgress {
 public:
  /// What a record calls its unit.
  using NameOf = std::function<std::string(const Json& record)>;

  /// Of so many units.
  UnitProgress(const std::string& what, std::size_t total, NameOf name_of)
      : progress_(what, static_cast<double>(total)), name_of_(std::move(name_of)) {}

  /// One more has ended, with this record.
  void end_unit(const Json& record);

  /// A signal stops the run, and so many units are at work.
  void tell_stop(std::size_t units);

  void finish() { progress_.finish(); }

 private:
  Progress progress_;
  NameOf name_of_;
  double ended_ = 0.0;
};

}  // namespace nbvopt
