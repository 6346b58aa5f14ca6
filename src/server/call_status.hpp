// From what went wrong to the status that a client sees.
#pragma once

#include <grpcpp/support/status.h>
#include <grpcpp/support/status_code_enum.h>

#include <exception>
#include <string>

#include "nbvopt/core/error.hpp"

namespace nbvopt {

/// A request that is refused with a status of its own.
class RequestError : public Error {
 public:
  RequestError(grpc::StatusCode code, const std::string& message) : Error(message), code_(code) {}
  grpc::StatusCode code() const { return code_; }

 private:
  grpc::StatusCode code_;
};

/// The status of an exception: a request's own error by its kind, anything else INTERNAL.
grpc::Status status_of(const std::exception& error);

/// What a client hears whose call found all threads and places in the queue taken.
grpc::Status shed_status();

}  // namespace nbvopt
