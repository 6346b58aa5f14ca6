// Which answers are still good: a study's units and cases by all that decides them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "study/study.hpp"

namespace nbvopt::study {

/// Fingerprints of everything that decides the answer: this program's version, the contents of map
/// and robot, start, motion time and mode of a case; besides, search, budget and seed of a unit.
/// They do not depend on where files lie, nor on what else is studied.
class Fingerprints {
 public:
  /// The study must outlive it.
  explicit Fingerprints(const Study& study);

  const std::string& of_case(std::size_t case_index);
  std::string of_unit(const UnitIndex& unit);

 private:
  const Study& study_;
  std::string robot_;                     ///< and the version
  std::optional<std::size_t> last_case_;  ///< units of a case are asked for one after the other
  std::string last_;
};

}  // namespace nbvopt::study
