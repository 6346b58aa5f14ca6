// A study: which searches answer which questions, and every unit of work that this makes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "nbvopt/mast/mast.hpp"
#include "nbvopt/planner/robot.hpp"
#include "study/results.hpp"
#include "study/search.hpp"

namespace nbvopt::study {

/// Where a robot stands, and its joints.
struct Start {
  double x_m = 0.0;
  double y_m = 0.0;
  double z_m = 0.0;
  double yaw_rad = 0.0;
  JointPosition joints;

  bool operator==(const Start&) const = default;
};

struct StudyMap {
  std::string name;  ///< the file's name, without its folder
  std::filesystem::path file;
  std::string digest;  ///< of the file's content
  std::vector<Start> starts;
};

struct NamedSearch {
  std::string label;
  StudySearch search;
};

/// The product of its lists. None of them is empty.
struct Study {
  std::string name;
  Robot robot;
  std::vector<StudyMap> maps;
  std::vector<double> motion_times_s;
  std::vector<UncertaintyMode> modes;
  std::vector<NamedSearch> searches;  ///< the first is the one that the others are compared with
  std::vector<Budget> budgets;
  std::vector<std::uint64_t> seeds;
  double unit_timeout_s = 60.0;        ///< a query that takes longer is stopped and has failed
  double reference_timeout_s = 900.0;  ///< the same for the reference search of a case
};

/// A question, by its place in the study's lists.
struct CaseIndex {
  std::size_t map = 0;
  std::size_t start = 0;
  std::size_t motion_time = 0;
  std::size_t mode = 0;
};

/// A unit of work, by its place in the study's lists.
struct UnitIndex {
  std::size_t case_index = 0;
  std::size_t search = 0;
  std::size_t budget = 0;
  std::size_t seed = 0;
};

std::size_t case_count(const Study& study);
std::size_t unit_count(const Study& study);

/// Cases and units in order: all that ask one map stand together.
CaseIndex case_at(const Study& study, std::size_t index);
UnitIndex unit_at(const Study& study, std::size_t index);

}  // namespace nbvopt::study
