// Lines through pipes.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace nbvopt::experiment {

/// Takes a descriptor's bytes apart into lines. The descriptor stays the caller's.
class LineReader {
 public:
  explicit LineReader(int descriptor) : descriptor_(descriptor) {}

  /// Reads what is there, once; it waits when nothing is. False at the end.
  bool read_some();

  /// The next whole line that was read, without its end; none: read more.
  std::optional<std::string> next_line();

  /// Waits for a whole line; none at the end. What is left without a line's end is dropped.
  std::optional<std::string> wait_for_line();

 private:
  int descriptor_;
  std::string bytes_;
  std::size_t searched_ = 0;  ///< so many of them hold no line's end
};

/// Writes the line and its end. Throws std::system_error when that fails; SIGPIPE must be ignored.
void write_line(int descriptor, std::string_view line);

}  // namespace nbvopt::experiment
