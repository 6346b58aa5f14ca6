#include "fields/keys.hpp"

#include <algorithm>

#include "core/edit_distance.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {

void KeyCheck::take(const std::string& key, const std::string& block, const std::string& name) {
  if (std::ranges::find(known_, key) == known_.end()) refuse_key(key, block, known_, noun_);
  if (std::ranges::find(taken_, key) != taken_.end()) {
    throw InputError(name + " is given twice, keep one");
  }
  taken_.push_back(key);
}

void refuse_key(const std::string& key, const std::string& block,
                std::span<const std::string> known, const std::string& noun) {
  throw InputError(block + ": unknown " + noun + " '" + key + "', did you mean '" +
                   nearest_word(key, known) + "'?");
}

void refuse_missing_value(const std::string& name) {
  throw InputError(name + " has no value, give one or leave the key out");
}

}  // namespace nbvopt
