// Encoding from Python.
#pragma once

#include <pybind11/pybind11.h>

namespace hmlfc::python {

/// Adds encode and read_views to the module.
void add_encode(pybind11::module_& module);

}  // namespace hmlfc::python
