// What the tool says: answers on standard output, warnings and errors on standard error.
#pragma once

#include <chrono>
#include <nlohmann/json.hpp>
#include <string>

namespace nbvopt {

/// JSON whose keys keep the order in which they were written.
using Json = nlohmann::ordered_json;

/// The object as indented text with a final line end. Names that are not UTF-8 are repaired.
std::string to_text(const Json& json);

/// Writes an answer to standard output. Throws InputError when that cannot be written.
void print_answer(const std::string& text);

/// Writes "nbvopt: <message>" as one line to standard error.
void print_message(const std::string& message);

/// Milliseconds since the stopwatch was made.
class Stopwatch {
 public:
  double elapsed_ms() const {
    return std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace nbvopt
