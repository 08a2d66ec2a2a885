// The module hmlfc._core, on which the package hmlfc is written.
#include <pybind11/pybind11.h>

#include <hmlfc/version.hpp>

#include "python/encode.hpp"
#include "python/stream.hpp"

PYBIND11_MODULE(_core, module) {
  module.attr("version") = hmlfc::library_version();
  hmlfc::python::add_stream(module);
  hmlfc::python::add_encode(module);
}
