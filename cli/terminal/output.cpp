#include "cli/terminal/output.hpp"

#include <algorithm>
#include <iostream>

#include "nbvopt/core/error.hpp"

namespace nbvopt {

void print_answer(const std::string& text) {
  std::cout << text << std::flush;
  if (!std::cout) throw InputError("standard output: cannot be written, is the disk full?");
}

void print_line(const std::string& line) { print_answer(line + '\n'); }

void print_message(const std::string& message) {
  std::string line = message;
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  std::cerr << "nbvopt: " << line << std::endl;
}

}  // namespace nbvopt
