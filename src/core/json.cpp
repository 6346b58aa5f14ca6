#include "core/json.hpp"

#include <algorithm>

#include "nbvopt/core/error.hpp"

namespace nbvopt {

std::string to_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

Json parse_json(const std::string& text, const std::string& name) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    const auto line = 1 + std::count(text.begin(), end, '\n');
    throw InputError(name + ": line " + std::to_string(line) + ": not valid JSON");
  } catch (const Json::exception&) {
    throw InputError(name + ": a number is too large");
  }
}

const Json& object_in(const Json& json, const std::string& name) {
  if (!json.is_object()) throw InputError(name + " must be an object {...}");
  return json;
}

double number_in(const Json& json, const std::string& name) {
  if (!json.is_number()) throw InputError(name + " must be a number");
  return json.get<double>();
}

}  // namespace nbvopt
