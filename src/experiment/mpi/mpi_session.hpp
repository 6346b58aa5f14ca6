// MPI, from its start to its end: messages between the processes that one mpirun has started.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

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
  /// Waits until all processes are as far.
  ~MpiSession();

  int rank() const { return rank_; }
  int size() const { return size_; }

  void send(int rank, int tag, std::string_view bytes) const;

  /// A message that has come; none when there is none.
  std::optional<Message> receive() const;

 private:
  MpiSession();

  int rank_ = 0;
  int size_ = 0;
};

}  // namespace nbvopt::experiment
