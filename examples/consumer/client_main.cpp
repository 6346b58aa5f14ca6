// Asks a server that is not there, with the installed package's client.
#include <cstdio>

#include "nbvopt/client/planner_client.hpp"

int main() {
  try {
    nbvopt::PlannerClient("unix:/none").status();
  } catch (const nbvopt::ServerError& error) {
    std::printf("%s\n", error.what());
    return error.kind() == nbvopt::ServerErrorKind::unavailable ? 0 : 1;
  }
  return 1;
}
