// The extension module nbvopt._sim: what needs the simulator, whose libraries take their time to
// load.
#include "python/sim_bindings.hpp"

PYBIND11_MODULE(_sim, module) {
  pybind11::module_::import("nbvopt._core");  // Map, Robot, and how errors are told
  nbvopt::python::bind_world(module);
  nbvopt::python::bind_episode(module);
  nbvopt::python::bind_simulate(module);
}
