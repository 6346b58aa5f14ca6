// A part of an experiment: what one of several runs does.
#pragma once

#include <cstddef>

namespace nbvopt::experiment {

/// Every count-th group of units from `index` on; units of a group stay together.
struct Shard {
  std::size_t index = 0;
  std::size_t count = 1;

  bool has(std::size_t group) const { return group % count == index; }
};

}  // namespace nbvopt::experiment
