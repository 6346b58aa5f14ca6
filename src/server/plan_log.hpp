// What plans came to, and the newest.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>

#include "nbvopt/planner/plan.hpp"
#include "nbvopt/sensor/gain_choice.hpp"
#include "nbvopt/v1/planner.pb.h"

namespace nbvopt {

/// Safe to share between threads.
class PlanLog {
 public:
  /// `gain` is what its views were judged by.
  void record(std::shared_ptr<const PlanResult> plan, const GainChoice& gain);

  struct Newest {
    std::shared_ptr<const PlanResult> plan;  ///< null: there is none yet
    GainChoice gain;
    std::uint64_t number = 0;  ///< of all plans, from 1 on
  };
  Newest newest() const;

  /// Adds the count of each status that a plan can have.
  void write(v1::GetStatusReply& reply) const;

 private:
  static constexpr std::size_t kStatuses = static_cast<std::size_t>(PlanStatus::certified) + 1;

  std::array<std::atomic<std::uint64_t>, kStatuses> counts_{};
  mutable std::mutex mutex_;
  Newest newest_;
};

}  // namespace nbvopt
