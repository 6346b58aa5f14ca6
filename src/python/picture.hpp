// Pictures for Python: bytes, or a file.
#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>
#include <optional>
#include <string>

#include "core/atomic_file.hpp"

namespace nbvopt::python {

/// The bytes that `draw` returns, or None where a path is given: they are written there then. Other
/// Python threads run meanwhile. Throws InputError when the file cannot be written.
template <class Draw>
pybind11::object png_or_file(const std::optional<std::filesystem::path>& path, const Draw& draw) {
  std::string png;
  {
    const pybind11::gil_scoped_release release;
    if (path) require_writable(*path);
    png = draw();
    if (path) write_file_atomically(*path, png);
  }
  if (path) return pybind11::none();
  return pybind11::bytes(png);
}

}  // namespace nbvopt::python
