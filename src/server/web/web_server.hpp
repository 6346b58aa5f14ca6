// What the server shows to browsers and monitors, by HTTP.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "nbvopt/v1/planner.pb.h"
#include "server/limits.hpp"
#include "server/listen_address.hpp"
#include "server/web/live_page.hpp"

namespace nbvopt {

/// What it shows. Called by any thread, until it is destroyed.
struct WebSources {
  std::function<v1::GetStatusReply()> status;
  LiveSources live;
};

/// Listens from its construction until stop(), or its destruction. Answers GET of
///   /         the page of the map, which asks for the next two
///   /events   LivePage::state() whenever it changes, as Server-Sent Events
///   /map      LivePage::map()
///   /metrics  the server's figures, for Prometheus
/// to who web_refusal() lets in. A connection is for one request and has a thread of its own.
class WebServer {
 public:
  /// Throws UsageError where the address is none, or is one that other machines can reach, and
  /// where this build has no such server; InputError where the address cannot be had.
  WebServer(const std::string& listen, const ServerLimits& limits, WebSources sources);
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;
  ~WebServer();

  /// What a browser is given: "http://127.0.0.1:8080/", the port that the system chose for 0 filled
  /// in, or "unix:PATH".
  std::string address() const;

  /// Ends what is under way.
  void stop();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace nbvopt
