#include "server/web/web_server.hpp"

#include <spdlog/spdlog.h>

#include <filesystem>
#include <mutex>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "nbvopt/core/error.hpp"
#include "server/acceptor.hpp"
#include "server/listening_socket.hpp"
#include "server/web/entry_rules.hpp"
#include "server/web/http_stream.hpp"
#include "server/web/metrics.hpp"
#include "server/work_queue.hpp"

namespace nbvopt {
namespace {

/// The library's parser and routes on our own connections.
class HttpServer : public httplib::Server {
 public:
  /// It takes a server without a listening socket for one that ends.
  HttpServer() { svr_sock_ = 0; }
  void end_answers() { svr_sock_ = INVALID_SOCKET; }

  void answer(HttpStream& stream) {
    bool is_closed = false;
    process_request(stream, true, is_closed, nullptr);
  }
};

/// The connections that have a thread, which can be ended from outside.
class OpenConnections {
 public:
  void add(int socket) {
    const std::scoped_lock lock(mutex_);
    sockets_.insert(socket);
    if (is_ending_) ::shutdown(socket, SHUT_RDWR);
  }
  /// Closes it.
  void remove(Descriptor socket) {
    const std::scoped_lock lock(mutex_);
    sockets_.erase(socket.get());
    socket.close();
  }
  void end_all() {
    const std::scoped_lock lock(mutex_);
    is_ending_ = true;
    for (const int socket : sockets_) ::shutdown(socket, SHUT_RDWR);
  }

 private:
  std::mutex mutex_;
  std::set<int> sockets_;
  bool is_ending_ = false;
};

WebCaller caller_of(const httplib::Request& request) {
  const auto header = [&](const char* name) { return request.get_header_value(name); };
  return {.method = request.method,
          .host = header("Host"),
          .origin = header("Origin"),
          .fetch_site = header("Sec-Fetch-Site"),
          .fetch_mode = header("Sec-Fetch-Mode"),
          .fetch_dest = header("Sec-Fetch-Dest")};
}

void refuse(httplib::Response& response, int status, const std::string& why) {
  response.status = status;
  response.set_content(why + "\n", "text/plain");
}

ListenAddress local_address(const std::string& listen) {
  ListenAddress address = parse_listen_address(listen, "web");
  if (address.is_local) return address;
  throw UsageError("web: '" + listen +
                   "' can be reached from other machines, the page is for this one alone: listen "
                   "on 127.0.0.1, and let others come through a tunnel such as ssh -L");
}

}  // namespace

struct WebServer::Parts {
  Parts(const std::string& listen, const ServerLimits& limits, WebSources web_sources)
      : sources(std::move(web_sources)),
        address(local_address(listen)),
        most_send(std::chrono::milliseconds(std::int64_t(limits.max_send_s * 1e3))),
        threads(static_cast<std::size_t>(limits.max_web_connections), 0) {
    set_up();
    std::vector<Descriptor> sockets = listen_on(address);
    acceptor.emplace(
        std::move(sockets), socket_budget(static_cast<std::size_t>(limits.max_web_connections)),
        log.connections,
        Acceptor::Hooks{.hand_over = [this](int socket, int) { hand_over(Descriptor(socket)); },
                        .on_room = [](bool) {}});
  }

  void set_up() {
    http.set_default_headers({{"Cache-Control", "no-store"},
                              {"Cross-Origin-Opener-Policy", "same-origin"},
                              {"Cross-Origin-Resource-Policy", "same-origin"},
                              {"Referrer-Policy", "no-referrer"},
                              {"X-Content-Type-Options", "nosniff"},
                              {"X-Frame-Options", "DENY"}});
    // All is answered here: the library matches paths by regular expressions, and would cut ranges
    // out of answers, as many as a request names.
    http.set_pre_routing_handler(
        [this](const httplib::Request& request, httplib::Response& response) {
          answer(request, response);
          return httplib::Server::HandlerResponse::Handled;
        });
    http.set_exception_handler(
        [](const httplib::Request&, httplib::Response& response, const std::exception_ptr&) {
          spdlog::error("event=internal_error in=web");
          refuse(response, 500, "internal error");
        });
  }

  void hand_over(Descriptor socket) {
    const int number = socket.get();
    open.add(number);
    const auto shared = std::make_shared<Descriptor>(std::move(socket));
    // There is a thread for each connection that the acceptor lets in.
    const bool is_taken = threads.try_post([this, shared] { serve(std::move(*shared)); });
    if (!is_taken) open.remove(std::move(*shared));
  }

  void serve(Descriptor socket) {
    try {
      HttpStream stream(socket, most_send);
      http.answer(stream);
      stream.finish();
    } catch (const std::exception& error) {
      spdlog::error("event=internal_error error=\"{}\"", error.what());
    }
    open.remove(std::move(socket));
  }

  void answer(const httplib::Request& request, httplib::Response& response) {
    const auto refusal = web_refusal(caller_of(request),
                                     address.socket ? WebReach::unix_socket : WebReach::loopback);
    if (refusal) {
      ++log.forbidden;
      return refuse(response, refusal->status, refusal->why);
    }
    if (!request.ranges.empty()) return refuse(response, 416, "ranges are not answered here");
    ++log.answers;
    response.status = 200;
    if (request.path == "/metrics") {
      response.set_content(metrics_text(sources.status(), log),
                           "text/plain; version=0.0.4; charset=utf-8");
    } else {
      refuse(response, 404, "there is no such page: see /metrics");
    }
  }

  void stop() {
    if (acceptor) acceptor->stop();
    std::error_code ignored;
    if (address.socket) std::filesystem::remove(*address.socket, ignored);
    http.end_answers();
    open.end_all();
  }

  const WebSources sources;
  ListenAddress address;
  const std::chrono::milliseconds most_send;
  WebLog log;
  HttpServer http;
  OpenConnections open;
  WorkQueue threads;
  std::optional<Acceptor> acceptor;
};

WebServer::WebServer(const std::string& listen, const ServerLimits& limits, WebSources sources)
    : parts_(std::make_unique<Parts>(listen, limits, std::move(sources))) {}

WebServer::~WebServer() { parts_->stop(); }

std::string WebServer::address() const {
  const ListenAddress& address = parts_->address;
  return address.socket ? address.text : "http://" + address.text + "/";
}

void WebServer::stop() { parts_->stop(); }

}  // namespace nbvopt
