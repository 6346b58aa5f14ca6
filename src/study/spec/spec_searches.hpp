// The searches that a spec lists.
#pragma once

#include <vector>

#include "study/spec/spec_block.hpp"
#include "study/study.hpp"

namespace nbvopt::study {

/// Reads the list: a parameter with several values makes a search a value, and the product of them
/// where several have. Each is named by its settings unless the spec names it, and tried on a
/// textbook function. Refuses what read_spec() says.
std::vector<NamedSearch> read_searches(const SpecValue& list, const SolverFactory& make);

/// Adds the paper's search, on its released code and at several steps on the exact gain, where it
/// is not among them.
void add_paper_searches(std::vector<NamedSearch>& searches);

}  // namespace nbvopt::study
