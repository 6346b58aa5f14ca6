// Where the workers of an experiment come from.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "experiment/mpi/mpi_session.hpp"
#include "experiment/pool.hpp"

namespace nbvopt::experiment {

/// The workers of a run: processes of this machine or, where mpirun started this program several
/// times, one of each process but the first. Made before anything else is done.
class Workers {
 public:
  /// `command`, a program and its arguments, starts a worker; `count` is that of this machine's.
  /// Throws InputError as MpiSession::begin().
  Workers(std::vector<std::string> command, std::size_t count);

  /// Whether this process serves another that coordinates: it has nothing to do but to serve().
  bool is_servant() const { return session_ != nullptr && session_->rank() != 0; }
  void serve() const;

  std::size_t count() const;

  /// The pool of a run. Throws InputError when it cannot be made.
  Pool& pool();

 private:
  std::vector<std::string> command_;
  std::size_t count_;
  std::unique_ptr<MpiSession> session_;
  std::unique_ptr<Pool> pool_;  ///< goes before the session
};

}  // namespace nbvopt::experiment
