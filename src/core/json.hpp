// JSON as the library writes it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace nbvopt {

/// JSON whose keys keep the order in which they were written.
using Json = nlohmann::ordered_json;

/// The object as indented text with a final line end. Names that are not UTF-8 are repaired.
std::string to_text(const Json& json);

}  // namespace nbvopt
