// The members of JSON objects that the tool wrote.
#pragma once

#include <string>

#include "core/json.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {

/// Looks members up; `where` names the object in messages, `writer` who writes such.
struct Members {
  const Json& object;
  std::string where;
  const char* writer;

  /// Throws InputError where it is missing.
  const Json& at(const char* key) const {
    const auto found = object_in(object, where).find(key);
    if (found == object.end()) {
      throw InputError(where + ": '" + key + "' is missing, give what " + writer + " wrote");
    }
    return *found;
  }

  /// Throws InputError as above, and where it is no number.
  double number(const char* key) const { return number_in(at(key), where + ": '" + key + "'"); }

  /// Throws InputError as above, and where it is no text.
  std::string text(const char* key) const {
    const Json& value = at(key);
    if (!value.is_string()) throw InputError(where + ": '" + key + "' must be a text");
    return value.get<std::string>();
  }

  Members members(const char* key) const { return {at(key), where + "." + key, writer}; }
};

}  // namespace nbvopt
