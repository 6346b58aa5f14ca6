// How far long work is, on standard error.
#pragma once

#include <chrono>
#include <string>

namespace nbvopt {

/// "<what>  42 %  [########............]  3 min left": how long the rest takes is judged by what is
/// done, and not told before anything is.
std::string progress_text(const std::string& what, double done, double total, double elapsed_s);

/// Shows progress: a bar that is drawn again in place when standard error is a terminal, otherwise
/// a line every half minute. The bar goes with the object.
class Progress {
 public:
  Progress(std::string what, double total);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() { finish(); }

  /// So much of the total is done; to be called as often as one likes.
  void update(double done);

  /// Takes the bar away: before a message, and at the end. The next update draws it again.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  std::string what_;
  double total_;
  bool is_terminal_;
  bool is_drawn_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_;  ///< not shown again before
};

}  // namespace nbvopt
