// The library's errors. Each message is one line that names the thing and the remedy.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace nbvopt {

/// Base of every error that the library throws on purpose.
class Error : public std::runtime_error {
 public:
  /// A zero byte, at which what() would end, is written out.
  explicit Error(const std::string& message) : std::runtime_error(with_zeros_escaped(message)) {}

 private:
  static std::string with_zeros_escaped(std::string message) {
    for (std::size_t i = 0; (i = message.find('\0', i)) != std::string::npos;) {
      message.replace(i, 1, "\\0");
    }
    return message;
  }
};

/// Data or a value that cannot be used: a file, a field, a pose. Command lines exit with 3.
class InputError : public Error {
 public:
  using Error::Error;
};

/// A call that breaks its contract, or names what does not exist. Command lines exit with 2.
class UsageError : public Error {
 public:
  using Error::Error;
};

/// Work that a CancelToken ended before it was done. Command lines never see it.
class CancelledError : public Error {
 public:
  using Error::Error;
};

}  // namespace nbvopt
