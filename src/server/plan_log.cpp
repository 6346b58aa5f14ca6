#include "server/plan_log.hpp"

#include "protocol/messages.hpp"

namespace nbvopt {

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
