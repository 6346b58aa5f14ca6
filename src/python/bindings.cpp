// The extension module nbvopt._core; nbvopt/__init__.py shows what it has.
#include "python/bindings.hpp"

#include <exception>
#include <utility>

#include "nbvopt/core/error.hpp"
#include "nbvopt/core/version.hpp"

PYBIND11_MODULE(_core, module) {
  module.attr("__version__") = nbvopt::version();
  // Callers cannot tell a bad file, a bad value and a name that does not exist by type, and need
  // not: the message does.
  pybind11::register_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(std::move(thrown));
    } catch (const nbvopt::Error& error) {
      PyErr_SetString(PyExc_ValueError, error.what());
    }
  });
  nbvopt::python::bind_robot(module);
  nbvopt::python::bind_map(module);
  nbvopt::python::bind_surrogate(module);
  nbvopt::python::bind_result(module);
  nbvopt::python::bind_planner(module);
}
