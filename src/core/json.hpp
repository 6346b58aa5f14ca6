// JSON as the library writes and reads it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace nbvopt {

/// JSON whose keys keep the order in which they were written.
using Json = nlohmann::ordered_json;

/// The object as indented text with a final line end. Names that are not UTF-8 are repaired.
std::string to_text(const Json& json);

/// `name` stands for the text in messages. Throws InputError that names the line where it is no
/// JSON, or says that a number is too large.
Json parse_json(const std::string& text, const std::string& name);

/// The value itself. Throws InputError "<name> must be an object {...}" where it is none.
const Json& object_in(const Json& json, const std::string& name);

/// Throws InputError "<name> must be a number" where it is none.
double number_in(const Json& json, const std::string& name);

}  // namespace nbvopt
