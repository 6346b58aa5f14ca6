#include "experiment/mpi/mpi_session.hpp"

#include <mpi.h>

#include <csignal>
#include <cstdlib>
#include <utility>

#include "experiment/mpi/mpi_environment.hpp"

namespace nbvopt::experiment {

struct MpiSession::Parcel {
  explicit Parcel(std::string&& sent) : bytes(std::move(sent)) {}

  std::string bytes;
  MPI_Request request = MPI_REQUEST_NULL;
};

std::unique_ptr<MpiSession> MpiSession::begin() {
  if (!is_started_by_mpirun()) return nullptr;
  return std::unique_ptr<MpiSession>(new MpiSession());
}

MpiSession::MpiSession() {
  // Threads of MPI's own must leave these signals to the coordinator.
  sigset_t held;
  sigset_t before;
  sigemptyset(&held);
  sigaddset(&held, SIGINT);
  sigaddset(&held, SIGTERM);
  ::pthread_sigmask(SIG_BLOCK, &held, &before);
  int threads = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &threads);
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
}

MpiSession::~MpiSession() {
  for (Parcel& parcel : on_their_way_) MPI_Wait(&parcel.request, MPI_STATUS_IGNORE);
  MPI_Finalize();
}

void MpiSession::send(int rank, int tag, std::string bytes) {
  Parcel& parcel = on_their_way_.emplace_back(std::move(bytes));
  MPI_Isend(parcel.bytes.data(), static_cast<int>(parcel.bytes.size()), MPI_BYTE, rank, tag,
            MPI_COMM_WORLD, &parcel.request);
  drop_arrived();
}

void MpiSession::drop_arrived() {
  on_their_way_.remove_if([](Parcel& parcel) {
    int has_arrived = 0;
    MPI_Test(&parcel.request, &has_arrived, MPI_STATUS_IGNORE);
    return has_arrived != 0;
  });
}

std::optional<MpiSession::Message> MpiSession::receive() {
  drop_arrived();
  int has_come = 0;
  MPI_Message handle = MPI_MESSAGE_NULL;
  MPI_Status status;
  MPI_Improbe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &has_come, &handle, &status);
  if (has_come == 0) return std::nullopt;
  int size = 0;
  MPI_Get_count(&status, MPI_BYTE, &size);
  Message message{status.MPI_SOURCE, status.MPI_TAG,
                  std::string(static_cast<std::size_t>(size), 0)};
  MPI_Mrecv(message.bytes.data(), size, MPI_BYTE, &handle, MPI_STATUS_IGNORE);
  return message;
}

}  // namespace nbvopt::experiment
