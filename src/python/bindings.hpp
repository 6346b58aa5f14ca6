// The parts of the Python module; each binds one subject. Order matters: what a part's signatures
// name must have been bound before.
#pragma once

#include <pybind11/pybind11.h>

namespace nbvopt::python {

void bind_robot(pybind11::module_& module);
void bind_map(pybind11::module_& module);
void bind_surrogate(pybind11::module_& module);
void bind_result(pybind11::module_& module);
void bind_planner(pybind11::module_& module);

}  // namespace nbvopt::python
