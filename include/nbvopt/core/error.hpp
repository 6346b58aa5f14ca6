// The library's errors. Each message is one line that names the thing and the remedy.
#pragma once

#include <stdexcept>
#include <string>

namespace nbvopt {

/// Base of every error that the library throws on purpose.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
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

}  // namespace nbvopt
