// The searches that are compared.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "nbvopt/solver/solver.hpp"

namespace nbvopt::bench {

struct Search {
  std::string name;
  std::string family;  ///< "pan grid", "joint grid", "exact only", "strategy" or "auto"
  std::shared_ptr<const Solver> solver;  ///< shared by searches that differ in other things
  bool on_paper_code = false;            ///< evaluates views by paper-code instead of exactly
  int threads = 1;
};

/// What all others are timed against: the paper's grid on the paper's code.
inline constexpr const char* kPaperSearch = "pan grid 0.8, paper-code";

/// The default strategy, as it is.
inline constexpr const char* kAutoSearch = "auto";

inline constexpr const char* kJointGrid = "joint grid";

/// The paper's pan grid, grids over all joints from coarse to fine, searches on the exact gain
/// alone, auto, and auto with one stage exchanged.
std::vector<Search> make_searches();

}  // namespace nbvopt::bench
