#include "cli/terminal/progress.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>

namespace nbvopt {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

/// Standard error is a terminal of its own while this lives.
class ErrorTerminal {
 public:
  ErrorTerminal() : master_(::posix_openpt(O_RDWR | O_NOCTTY)), standard_error_(::dup(2)) {
    EXPECT_EQ(::grantpt(master_), 0);
    EXPECT_EQ(::unlockpt(master_), 0);
    slave_ = ::open(::ptsname(master_), O_RDWR | O_NOCTTY);
    ::dup2(slave_, 2);
  }
  ~ErrorTerminal() {
    ::dup2(standard_error_, 2);
    for (const int descriptor : {slave_, master_, standard_error_}) ::close(descriptor);
  }

  /// What was drawn since the last call; something must have been.
  std::string drawn() const {
    std::array<char, 4096> buffer;
    const ssize_t count = ::read(master_, buffer.data(), buffer.size());
    return {buffer.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0))};
  }

 private:
  int master_;
  int standard_error_;
  int slave_ = -1;
};

TEST(ProgressText, TellsShareBarAndTimeLeft) {
  EXPECT_EQ(progress_text("explore", 25.0, 100.0, 10.0),
            "explore   25 %  [#####...............]  30 s left");
  EXPECT_THAT(progress_text("w", 1.0, 2.0, 600.0), EndsWith("10 min left"));
  EXPECT_THAT(progress_text("w", 1.0, 2.0, 36000.0), EndsWith("10 h left"));
}

TEST(ProgressText, TellsNoTimeBeforeAnythingIsDone) {
  EXPECT_EQ(progress_text("w", 0.0, 10.0, 5.0), "w    0 %  [....................]");
}

TEST(ProgressText, StaysWithinItsBar) {
  EXPECT_EQ(progress_text("w", 12.0, 10.0, 5.0), "w  100 %  [####################]  0 s left");
  EXPECT_THAT(progress_text("w", -1.0, 10.0, 5.0), HasSubstr("  0 %"));
  EXPECT_THAT(progress_text("w", 0.0, 0.0, 5.0), HasSubstr("100 %"));
}

TEST(Progress, DrawsOnATerminalAndLeavesNothingThere) {
  const ErrorTerminal terminal;
  Progress progress("work", 4.0);
  progress.update(1.0);
  EXPECT_THAT(terminal.drawn(), HasSubstr("work   25 %"));
  progress.finish();
  EXPECT_EQ(terminal.drawn(), "\r\033[K");
  progress.update(2.0);
  EXPECT_THAT(terminal.drawn(), HasSubstr("work   50 %")) << "after a message it comes back";
}

TEST(Progress, IsQuietForShortWorkWithoutATerminal) {
  testing::internal::CaptureStderr();
  {
    Progress progress("work", 4.0);
    for (int i = 0; i < 4; ++i) progress.update(i);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace nbvopt
