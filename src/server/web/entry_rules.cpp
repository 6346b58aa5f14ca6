#include "server/web/entry_rules.hpp"

#include "server/listen_address.hpp"

namespace nbvopt {
namespace {

/// The name in a Host header, which may have a port.
std::string name_in(const std::string& host) {
  const auto end = host.starts_with('[') ? host.find(']') : host.find(':');
  if (end == std::string::npos) return host;
  return host.starts_with('[') ? host.substr(1, end - 1) : host.substr(0, end);
}

/// Whether the browser says that another page asks for this.
bool is_cross_site(const WebCaller& caller) {
  if (caller.fetch_site.empty()) return false;  // no browser, or an old one
  if (caller.fetch_site == "same-origin" || caller.fetch_site == "none") return false;
  const bool is_link = caller.fetch_mode == "navigate" && caller.fetch_dest == "document";
  return !is_link;
}

}  // namespace

std::optional<WebRefusal> web_refusal(const WebCaller& caller, WebReach reach) {
  if (caller.method != "GET" && caller.method != "HEAD") {
    return WebRefusal{405, "only GET and HEAD are answered here"};
  }
  // A name that leads here may be anybody's. Ports differ where the way is a tunnel.
  if (reach == WebReach::loopback && !is_loopback(name_in(caller.host))) {
    return WebRefusal{403, "this server is called localhost, 127.0.0.1 or [::1]"};
  }
  if (!caller.origin.empty() && caller.origin != "http://" + caller.host) {
    return WebRefusal{403, "pages of other servers may not ask this one"};
  }
  if (is_cross_site(caller)) {
    return WebRefusal{403, "pages of other servers may not ask this one"};
  }
  return std::nullopt;
}

}  // namespace nbvopt
