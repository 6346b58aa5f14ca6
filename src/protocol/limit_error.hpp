// A request that goes beyond one of the server's limits.
#pragma once

#include "nbvopt/core/error.hpp"

namespace nbvopt {

/// The message names the limit, its value, and the option that sets it.
class LimitError : public Error {
 public:
  using Error::Error;
};

}  // namespace nbvopt
