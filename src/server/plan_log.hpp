// What plans came to.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "nbvopt/planner/plan.hpp"
#include "nbvopt/v1/planner.pb.h"

namespace nbvopt {

/// Safe to share between threads.
class PlanLog {
 public:
  void record(PlanStatus status) { ++counts_.at(static_cast<std::size_t>(status)); }

  /// Adds the count of each status that a plan can have.
  void write(v1::GetStatusReply& reply) const;

 private:
  static constexpr std::size_t kStatuses = static_cast<std::size_t>(PlanStatus::certified) + 1;

  std::array<std::atomic<std::uint64_t>, kStatuses> counts_{};
};

}  // namespace nbvopt
