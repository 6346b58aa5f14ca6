// A request that is refused with a status of its own.
#pragma once

#include <grpcpp/support/status_code_enum.h>

#include <string>

#include "nbvopt/core/error.hpp"

namespace nbvopt {

class RequestError : public Error {
 public:
  RequestError(grpc::StatusCode code, const std::string& message) : Error(message), code_(code) {}
  grpc::StatusCode code() const { return code_; }

 private:
  grpc::StatusCode code_;
};

}  // namespace nbvopt
