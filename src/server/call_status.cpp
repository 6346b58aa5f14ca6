#include "server/call_status.hpp"

#include <new>

#include "nbvopt/core/error.hpp"
#include "protocol/limit_error.hpp"
#include "server/request_error.hpp"

namespace nbvopt {

grpc::Status status_of(const std::exception& error) {
  if (const auto* request = dynamic_cast<const RequestError*>(&error)) {
    return {request->code(), error.what()};
  }
  if (dynamic_cast<const LimitError*>(&error) != nullptr) {
    return {grpc::StatusCode::OUT_OF_RANGE, error.what()};
  }
  if (dynamic_cast<const Error*>(&error) != nullptr) {  // InputError, UsageError
    return {grpc::StatusCode::INVALID_ARGUMENT, error.what()};
  }
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) {
    return {grpc::StatusCode::RESOURCE_EXHAUSTED, "the server is out of memory"};
  }
  return {grpc::StatusCode::INTERNAL, std::string("internal error: ") + error.what()};
}

grpc::Status shed_status() {
  return {grpc::StatusCode::RESOURCE_EXHAUSTED, "the server is busy, ask again later"};
}

}  // namespace nbvopt
