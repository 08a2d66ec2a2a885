// Encoding from Python.
#pragma once

#include <pybind11/pybind11.h>

namespace hmlfc::python {

/// Adds class Field to the module: from_folder() and from_array(), pixels(), encode().
void add_encode(pybind11::module_& module);

}  // namespace hmlfc::python
