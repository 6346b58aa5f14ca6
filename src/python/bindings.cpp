// The extension module nbvopt._core; nbvopt/__init__.py shows what it has.
#include "python/bindings.hpp"

#include "nbvopt/core/error.hpp"
#include "nbvopt/core/version.hpp"

PYBIND11_MODULE(_core, module) {
  using namespace nbvopt::python;
  module.attr("__version__") = nbvopt::version();
  // Callers cannot tell a bad file, a bad value and a name that does not exist by type, and need
  // not: the message does.
  pybind11::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const nbvopt::Error& error) {
      PyErr_SetString(PyExc_ValueError, error.what());
    }
  });
  bind_map(module);
  bind_robot(module);
  bind_views(module);
  bind_surrogate(module);
  bind_query(module);
}
