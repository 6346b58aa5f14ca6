// Workers on other machines: a process of each rank of MPI but the first, which coordinates them.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "experiment/mpi/mpi_session.hpp"
#include "experiment/pool.hpp"

namespace nbvopt::experiment {

/// The workers as the first rank sees them. Worker i is that of rank i + 1, where serve_rank()
/// starts it, hands it its units and ends it when it hangs. A rank that ends takes all others with
/// it, as MPI has it; what has been recorded stays.
class MpiPool final : public Pool {
 public:
  /// The session must outlive it.
  explicit MpiPool(MpiSession& session);
  MpiPool(const MpiPool&) = delete;
  MpiPool& operator=(const MpiPool&) = delete;
  /// Sends all ranks home.
  ~MpiPool() override;

  std::size_t size() const override { return workers_.size(); }
  void start(std::size_t worker) override;
  std::size_t most_units_a_worker() const override { return 256; }
  void hand_out(std::size_t worker, std::span<const Unit> units) override;
  void stop(std::size_t worker) override;
  std::vector<PoolEvent> wait(Clock::time_point until, int wake) override;
  void require_files(std::span<const std::filesystem::path> files) override;

 private:
  struct Worker {
    std::uint64_t life = 0;  ///< how often it was started; what an earlier one says is too late
    std::deque<std::string> units;  ///< the ids of those that it has
  };

  void take(const MpiSession::Message& message, std::vector<PoolEvent>& events);

  MpiSession& session_;
  std::vector<Worker> workers_;
};

/// What a rank but the first does: it serves the first one's pool with a worker that the command
/// starts, until it is sent home.
void serve_rank(MpiSession& session, const std::vector<std::string>& command);

}  // namespace nbvopt::experiment
