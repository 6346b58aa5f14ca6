// The file that declares a study.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/study.hpp"

namespace nbvopt::study {

/// A study with what was noticed when it was read, such as optional maps that are not there.
struct DeclaredStudy {
  Study study;
  std::vector<std::string> remarks;
};

/// Reads a spec (docs/guide/studies.md lists its keys), looks for its maps beside it, draws the
/// starts, and adds the paper's searches where it does not list them. Throws InputError that names
/// file, line and key: what is not YAML, an unknown or repeated key, a wrong value, an unknown
/// solver, a map that is missing, a list that is empty.
DeclaredStudy read_spec(
    const std::filesystem::path& path,
    const SolverFactory& make = [](const Search& search) { return make_solver(search); });

}  // namespace nbvopt::study
