// The server's figures as Prometheus reads them.
#pragma once

#include <string>

#include "nbvopt/v1/planner.pb.h"
#include "server/web/web_log.hpp"

namespace nbvopt {

/// The text format, version 0.0.4: what GetStatus tells, and of the page's server.
std::string metrics_text(const v1::GetStatusReply& status, const WebLog& web);

}  // namespace nbvopt
