// A worker with solvers that misbehave, by their evaluator's step: a solver of that kind cannot be
// registered by a user, but what stands for it (an endless loop, a crash, an exception) can happen.
#include <unistd.h>

#include <cstdlib>
#include <stdexcept>
#include <thread>

#include "experiment/worker.hpp"
#include "study/unit_runner.hpp"

namespace nbvopt::study {
namespace {

class OddSolver final : public Solver {
 public:
  explicit OddSolver(const Search& search)
      : usual_(make_solver(search)), step_pan_rad_(search.grid_steps[0]) {}
  std::string name() const override { return "odd"; }

 private:
  SolveResult do_solve(const Objective& objective, const SolveRequest& request) const override {
    // The first steps of the pan grid, which no other test uses.
    if (step_pan_rad_ == 0.11) throw std::runtime_error("the solver threw");
    if (step_pan_rad_ == 0.12) {
      while (true) std::this_thread::sleep_for(std::chrono::hours(1));
    }
    if (step_pan_rad_ == 0.13) std::abort();
    if (step_pan_rad_ == 0.14) ::write(STDOUT_FILENO, "noise\n", 6);
    return usual_->solve(objective, request);
  }

  std::unique_ptr<Solver> usual_;
  double step_pan_rad_;
};

}  // namespace
}  // namespace nbvopt::study

int main() {
  using namespace nbvopt::study;
  UnitRunner runner(
      [](const nbvopt::Search& search) { return std::make_unique<OddSolver>(search); });
  nbvopt::experiment::run_worker(STDIN_FILENO, STDOUT_FILENO, [&](const nbvopt::Json& unit) {
    return runner.run(unit_of(unit));
  });
}
