#include "experiment/workers.hpp"

#include <utility>

#include "experiment/mpi/mpi_pool.hpp"
#include "experiment/process_pool.hpp"

namespace nbvopt::experiment {

Workers::Workers(std::vector<std::string> command, std::size_t count)
    : command_(std::move(command)), count_(count), session_(MpiSession::begin()) {
  // At once: it sends the ranks home when anything goes wrong.
  if (session_ != nullptr && !is_servant()) pool_ = std::make_unique<MpiPool>(*session_);
}

void Workers::serve() const { serve_rank(*session_, command_); }

std::size_t Workers::count() const {
  return session_ != nullptr ? static_cast<std::size_t>(session_->size() - 1) : count_;
}

Pool& Workers::pool() {
  if (pool_ == nullptr) pool_ = std::make_unique<ProcessPool>(command_, count_);
  return *pool_;
}

}  // namespace nbvopt::experiment
