// MPI's stand-in where its package was missing when this was built.
#include "experiment/mpi/mpi_environment.hpp"
#include "experiment/mpi/mpi_session.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt::experiment {

std::unique_ptr<MpiSession> MpiSession::begin() {
  if (is_started_by_mpirun()) {
    throw InputError(
        "mpirun started several processes, and this nbvopt was built without MPI: install "
        "libopenmpi-dev and build again, or start it without mpirun");
  }
  return nullptr;
}

struct MpiSession::Parcel {};

MpiSession::MpiSession() = default;
MpiSession::~MpiSession() = default;
void MpiSession::send(int /*rank*/, int /*tag*/, std::string /*bytes*/) {}
std::optional<MpiSession::Message> MpiSession::receive() { return std::nullopt; }

}  // namespace nbvopt::experiment
