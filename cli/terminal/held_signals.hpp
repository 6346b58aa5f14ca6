// Ctrl-C and SIGTERM, held until a piece of work is done.
#pragma once

#include <csignal>
#include <optional>

namespace nbvopt {

/// While it lives, SIGINT and SIGTERM wait in this thread, and in those that it starts.
class HeldSignals {
 public:
  HeldSignals();
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;
  ~HeldSignals();

  /// Takes one that has come; at once.
  std::optional<int> take() const;

 private:
  sigset_t held_{};
  sigset_t before_{};
};

}  // namespace nbvopt
