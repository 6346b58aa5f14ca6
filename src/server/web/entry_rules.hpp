// Who may ask the page's server for something.
//
// A browser sends requests wherever any page tells it to, and lets a page read the answer of a name
// that its own server resolves to 127.0.0.1 (DNS rebinding). What another page asks is refused.
#pragma once

#include <optional>
#include <string>

namespace nbvopt {

/// What a request says of where it comes from; empty where it does not.
struct WebCaller {
  std::string method = {};
  std::string host = {};        ///< Host
  std::string origin = {};      ///< Origin
  std::string fetch_site = {};  ///< Sec-Fetch-Site
  std::string fetch_mode = {};  ///< Sec-Fetch-Mode
  std::string fetch_dest = {};  ///< Sec-Fetch-Dest
};

struct WebRefusal {
  int status = 403;  ///< of HTTP
  std::string why;   ///< one line
};

enum class WebReach {
  loopback,     ///< a TCP address of this machine
  unix_socket,  ///< which no browser reaches
};

/// None where the request may be answered.
std::optional<WebRefusal> web_refusal(const WebCaller& caller, WebReach reach);

}  // namespace nbvopt
