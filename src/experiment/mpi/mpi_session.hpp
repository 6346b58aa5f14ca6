// MPI, from its start to its end: messages between the processes that one mpirun has started.
#pragma once

#include <list>
#include <memory>
#include <optional>
#include <string>

namespace nbvopt::experiment {

/// One at a time, of a process's first thread.
class MpiSession {
 public:
  struct Message {
    int rank = 0;  ///< that sent it
    int tag = 0;
    std::string bytes;
  };

  /// Starts MPI where mpirun has started this process beside others; null elsewhere. Throws
  /// InputError where it has and this program was built without MPI.
  static std::unique_ptr<MpiSession> begin();

  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;
  /// Waits until what was sent has arrived, and all processes are as far.
  ~MpiSession();

  int rank() const { return rank_; }
  int size() const { return size_; }

  /// Returns at once, whatever the rank is doing; messages come in the order in which they were
  /// sent.
  void send(int rank, int tag, std::string bytes);

  /// A message that has come; none when there is none.
  std::optional<Message> receive();

 private:
  /// A message on its way, with its bytes, whose place MPI knows.
  struct Parcel;

  MpiSession();
  void drop_arrived();

  int rank_ = 0;
  int size_ = 0;
  std::list<Parcel> on_their_way_;
};

}  // namespace nbvopt::experiment
