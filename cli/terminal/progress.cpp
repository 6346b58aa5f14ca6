#include "cli/terminal/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <utility>

#include "cli/terminal/output.hpp"

namespace nbvopt {
namespace {

using Seconds = std::chrono::duration<double>;

constexpr auto kBetweenDrawings = std::chrono::milliseconds(100);
constexpr auto kBetweenLines = std::chrono::seconds(30);
constexpr const char* kClearLine = "\r\033[K";

std::string duration_text(double duration_s) {
  if (duration_s < 100.0) return std::to_string(std::lround(duration_s)) + " s";
  if (duration_s < 6000.0) return std::to_string(std::lround(duration_s / 60.0)) + " min";
  return std::to_string(std::lround(duration_s / 3600.0)) + " h";
}

}  // namespace

std::string progress_text(const std::string& what, double done, double total, double elapsed_s) {
  constexpr int kWidth = 20;
  const double share = total > 0.0 ? std::clamp(done / total, 0.0, 1.0) : 1.0;
  const auto filled = static_cast<std::size_t>(share * kWidth);
  const std::string percent = std::to_string(static_cast<int>(share * 100.0));
  std::string text = what + "  " + std::string(3 - percent.size(), ' ') + percent + " %  [" +
                     std::string(filled, '#') + std::string(kWidth - filled, '.') + "]";
  if (share > 0.0) text += "  " + duration_text(elapsed_s * (1.0 - share) / share) + " left";
  return text;
}

Progress::Progress(std::string what, double total)
    : what_(std::move(what)),
      total_(total),
      is_terminal_(::isatty(STDERR_FILENO) == 1),
      next_(is_terminal_ ? start_ : start_ + kBetweenLines) {}

void Progress::update(double done) {
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  const std::string text = progress_text(what_, done, total_, Seconds(now - start_).count());
  if (is_terminal_) {
    std::cerr << kClearLine + text << std::flush;  // in one piece, or it flickers
    is_drawn_ = true;
    next_ = now + kBetweenDrawings;
  } else {
    print_message(text);
    next_ = now + kBetweenLines;
  }
}

void Progress::finish() {
  if (!is_drawn_) return;
  std::cerr << kClearLine << std::flush;
  is_drawn_ = false;
  next_ = Clock::time_point();
}

}  // namespace nbvopt
