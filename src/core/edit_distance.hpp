// Spelling help for messages.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace nbvopt {

/// How many insertions, deletions and replacements of a character turn one word into the other.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate with the least edit distance, the first of several. Requires candidates.
std::string nearest_word(std::string_view word, std::span<const std::string> candidates);

}  // namespace nbvopt
