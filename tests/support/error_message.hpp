// What an error says.
#pragma once

#include <functional>
#include <string>

namespace nbvopt::test {

/// The message of the Error that the call throws; empty when it throws nothing. Errors of other
/// types pass through.
template <class Error>
std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace nbvopt::test
