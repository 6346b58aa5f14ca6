#include "server/web/web_server.hpp"

#include <spdlog/spdlog.h>
#include <sys/socket.h>

#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "core/shared_bytes.hpp"
#include "nbvopt/core/error.hpp"
#include "server/acceptor.hpp"
#include "server/listening_socket.hpp"
#include "server/web/connections.hpp"
#include "server/web/entry_rules.hpp"
#include "server/web/event_stream.hpp"
#include "server/web/http_stream.hpp"
#include "server/web/live_page.hpp"
#include "server/web/metrics.hpp"
#include "web/page.hpp"

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

/// Answers with bytes that others may hold, too. The library would compress a body of its own for
/// each who asks, and copy it.
void give(httplib::Response& response, SharedBytes bytes, const char* type) {
  const std::size_t size = bytes.size();
  response.set_content_provider(
      size, type,
      [bytes = std::move(bytes), next = std::size_t{0}](std::size_t, std::size_t,
                                                        httplib::DataSink& sink) mutable {
        // Small pieces are sent together.
        const std::vector<SharedBytes::Piece>& pieces = bytes.pieces();
        std::string part;
        while (next < pieces.size() && part.size() < HttpStream::kPartBytes / 2) {
          part += *pieces[next++];
        }
        return sink.write(part.data(), part.size());
      });
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
        page(sources.live),
        address(local_address(listen)),
        most_send(std::chrono::milliseconds(std::int64_t(limits.max_send_s * 1e3))),
        readers(limits.max_web_connections / 2) {
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
    // Of an answer that nobody takes the system keeps this much, and not megabytes.
    constexpr int kSendBytes = 128 << 10;
    ::setsockopt(socket.get(), SOL_SOCKET, SO_SNDBUF, &kSendBytes, sizeof(kSendBytes));
    const int number = socket.get();
    open.add(number);
    const auto shared = std::make_shared<Descriptor>(std::move(socket));
    try {
      threads.start([this, shared] { serve(std::move(*shared)); });
    } catch (const std::system_error& error) {
      spdlog::warn("event=no_thread_for_web error=\"{}\"", error.what());
      open.remove(std::move(*shared));
    }
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
    if (request.path == "/") {
      response.set_header("Content-Security-Policy",
                          page_policy(PageKind::live) + "; frame-ancestors 'none'");
      give(response, SharedBytes(page.html()), "text/html; charset=utf-8");
    } else if (request.path == "/map") {
      give(response, page.map(request.get_param_value("since")), "application/json");
    } else if (request.path == "/gains") {
      give(response, SharedBytes(page.gains()), "application/json");
    } else if (request.path == "/events") {
      tell(response);
    } else if (request.path == "/metrics") {
      give(response, SharedBytes(metrics_text(sources.status(), log)),
           "text/plain; version=0.0.4; charset=utf-8");
    } else {
      refuse(response, 404, "there is no such page: see / and /metrics");
    }
  }

  /// Tells of changes until the reader or the server ends.
  void tell(httplib::Response& response) {
    const auto place = std::make_shared<OpenStreams::Place>(readers);
    if (!place->is_taken()) {
      return refuse(response, 503, "too many pages are open, close one or ask again later");
    }
    const auto stream = std::make_shared<EventStream>(page, log, most_send);
    response.set_chunked_content_provider(
        "text/event-stream", [this, place, stream](std::size_t, httplib::DataSink& sink) {
          return stream->turn(sink.is_writable(), [&](const std::string& event) {
            return sink.write(event.data(), event.size());
          }) && open.wait(EventStream::kTurn);
        });
  }

  void stop() {
    if (acceptor) acceptor->stop();
    std::error_code ignored;
    if (address.socket) std::filesystem::remove(*address.socket, ignored);
    http.end_answers();
    page.end();
    open.end_all();
  }

  const WebSources sources;
  LivePage page;
  ListenAddress address;
  const std::chrono::milliseconds most_send;
  WebLog log;
  HttpServer http;
  OpenStreams readers;
  OpenConnections open;
  ConnectionThreads threads;
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
