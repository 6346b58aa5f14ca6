#include "server/call_status.hpp"

#include <new>
#include <string>

#include "nbvopt/core/error.hpp"
#include "protocol/limit_error.hpp"

namespace nbvopt {

grpc::Status status_of(const std::exception& error) {
  // A message may quote what the client sent; gRPC sends no more than some kilobytes.
  constexpr std::size_t kMost = 1000;
  const std::string message = std::string(error.what()).substr(0, kMost);
  if (const auto* request = dynamic_cast<const RequestError*>(&error)) {
    return {request->code(), message};
  }
  if (dynamic_cast<const LimitError*>(&error) != nullptr) {
    return {grpc::StatusCode::OUT_OF_RANGE, message};
  }
  if (dynamic_cast<const CancelledError*>(&error) != nullptr) {
    return {grpc::StatusCode::CANCELLED, message};
  }
  if (dynamic_cast<const Error*>(&error) != nullptr) {  // InputError, UsageError
    return {grpc::StatusCode::INVALID_ARGUMENT, message};
  }
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) {
    return {grpc::StatusCode::RESOURCE_EXHAUSTED, "the server is out of memory"};
  }
  return {grpc::StatusCode::INTERNAL, std::string("internal error: ") + message};
}

grpc::Status shed_status() {
  return {grpc::StatusCode::RESOURCE_EXHAUSTED, "the server is busy, ask again later"};
}

}  // namespace nbvopt
