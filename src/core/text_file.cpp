#include "core/text_file.hpp"

#include <iterator>

#include "core/input_file.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {

std::string read_text_file(const std::filesystem::path& path) {
  std::ifstream in = open_input_file(path);
  return read_text(in, path.string());
}

std::string read_text(std::istream& in, const std::string& name) {
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (in.bad()) throw InputError(name + ": cannot be read, is it a regular file?");
  return text;
}

}  // namespace nbvopt
