#include "server/versions.hpp"

#include <google/protobuf/stubs/common.h>
#include <grpcpp/grpcpp.h>
#include <spdlog/version.h>

#include "nbvopt/core/version.hpp"

namespace nbvopt {

std::string server_version_report() {
  return version_report() + "\ngRPC " + grpc::Version() + "\nProtocol Buffers " +
         google::protobuf::internal::VersionString(GOOGLE_PROTOBUF_VERSION) + "\nspdlog " +
         std::to_string(SPDLOG_VER_MAJOR) + '.' + std::to_string(SPDLOG_VER_MINOR) + '.' +
         std::to_string(SPDLOG_VER_PATCH);
}

}  // namespace nbvopt
