// Work that is done in units, whatever they are about: what the engine asks of an experiment.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/json.hpp"

namespace nbvopt::experiment {

/// A unit of work as its worker gets it.
struct Unit {
  std::string id;  ///< its fingerprint: what is equal has the same answer
  Json payload;    ///< an object with all else that its worker needs to know
};

/// How a unit ended.
struct Outcome {
  Json answer;               ///< an object; null when it failed
  std::string failure = {};  ///< why; empty otherwise
  double busy_ms = 0.0;      ///< that it took; 0 where its worker ended
};

/// Where in a unit's payload files are named, as JSON pointers.
struct UnitFiles {
  std::vector<std::string> reads;
  std::vector<std::string> writes;
};

/// Units by their index, and what is kept of them.
class Work {
 public:
  virtual ~Work() = default;

  /// That of the unit.
  virtual std::string id(std::size_t index) = 0;

  /// Made when it is handed out, since there may be very many.
  virtual Unit unit(std::size_t index) = 0;

  /// What is kept of a unit that has ended this way.
  virtual Json record(std::size_t index, const Outcome& outcome) = 0;

  /// A unit that must have succeeded before.
  virtual std::optional<std::size_t> predecessor(std::size_t /*index*/) const {
    return std::nullopt;
  }

  /// The files that the unit's payload names.
  virtual UnitFiles files(std::size_t /*index*/) const { return {}; }
};

}  // namespace nbvopt::experiment
