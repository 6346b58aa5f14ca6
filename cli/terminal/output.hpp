// What the tool says: answers on standard output, warnings and errors on standard error.
#pragma once

#include <string>

namespace nbvopt {

/// Writes an answer to standard output. Throws InputError when that cannot be written.
void print_answer(const std::string& text);

/// The same for a line without its end.
void print_line(const std::string& line);

/// Writes "nbvopt: <message>" as one line to standard error.
void print_message(const std::string& message);

}  // namespace nbvopt
