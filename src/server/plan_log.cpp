#include "server/plan_log.hpp"

#include <utility>

#include "protocol/plan_messages.hpp"

namespace nbvopt {

void PlanLog::record(std::shared_ptr<const PlanResult> plan, const GainChoice& gain) {
  ++counts_.at(static_cast<std::size_t>(plan->status));
  const std::scoped_lock lock(mutex_);
  newest_.plan.swap(plan);  // the one before, if nobody shows it, goes after the lock
  newest_.gain = gain;
  ++newest_.number;
}

PlanLog::Newest PlanLog::newest() const {
  const std::scoped_lock lock(mutex_);
  return newest_;
}

void PlanLog::write(v1::GetStatusReply& reply) const {
  for (std::size_t i = 0; i < kStatuses; ++i) {
    const auto status = static_cast<PlanStatus>(i);
    if (status == PlanStatus::not_run) continue;
    v1::PlanCount& count = *reply.add_plans();
    count.set_status(to_message(status));
    count.set_plans(counts_[i]);
  }
}

}  // namespace nbvopt
