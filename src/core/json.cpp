#include "core/json.hpp"

namespace nbvopt {

std::string to_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace nbvopt
