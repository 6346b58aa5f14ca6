#include "cli/options/server_arguments.hpp"

#include <CLI/Option.hpp>

#include "cli/options/arguments.hpp"

namespace nbvopt {

CLI::Option* add_server_arguments(CLI::App& app, ServerArguments& arguments) {
  CLI::Option* server =
      app.add_option("--server", arguments.address, "HOST:PORT or unix:PATH")->type_name("ADDRESS");
  add_pem(app, "--tls-ca", arguments.tls.server_ca, "who signs the server's certificate")
      ->needs(server);
  add_pem(app, "--tls-cert", arguments.tls.certificate, "the caller's certificate")->needs(server);
  add_pem(app, "--tls-key", arguments.tls.key, "its private key")->needs(server);
  return server;
}

}  // namespace nbvopt
