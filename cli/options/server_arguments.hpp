// Which planning server is asked, and how it knows the caller.
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "nbvopt/client/planner_client.hpp"

namespace nbvopt {

struct ServerArguments {
  std::string address;  ///< empty: none
  ClientTls tls;
};

/// --server and its certificates; returns --server.
CLI::Option* add_server_arguments(CLI::App& app, ServerArguments& arguments);

}  // namespace nbvopt
