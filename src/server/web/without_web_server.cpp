// Stands in for web_server.cpp in a program without the libraries that it needs.
#include "nbvopt/core/error.hpp"
#include "server/web/web_server.hpp"

namespace nbvopt {

struct WebServer::Parts {};

WebServer::WebServer(const std::string& /*listen*/, const ServerLimits& /*limits*/,
                     WebSources /*sources*/) {
  throw UsageError(
      "web: this build has no web server: install libcpp-httplib-dev and prometheus-cpp-dev, and "
      "build again with NBVOPT_BUILD_CLI");
}

WebServer::~WebServer() = default;

std::string WebServer::address() const { return {}; }

void WebServer::stop() {}

}  // namespace nbvopt
