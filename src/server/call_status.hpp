// From what went wrong to the status that a client sees.
#pragma once

#include <grpcpp/support/status.h>

#include <exception>

namespace nbvopt {

/// The status of an exception: a request's own error by its kind, anything else INTERNAL.
grpc::Status status_of(const std::exception& error);

/// What a client hears whose call found all threads and places in the queue taken.
grpc::Status shed_status();

}  // namespace nbvopt
