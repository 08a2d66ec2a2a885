// Errors of the library as Python exceptions.
#pragma once

#include <utility>

#include <pybind11/pybind11.h>

#include <hmlfc/error.hpp>

namespace hmlfc::python {

/// Raises hmlfc.Error for `error`; needs the GIL.
[[noreturn]] inline void raise(const Error& error) {
  if (error.code == ErrorCode::kOutOfMemory) throw std::bad_alloc();
  namespace py = pybind11;
  const py::object type = py::module_::import("hmlfc").attr("Error");
  const py::object exception = type(to_string(error), py::str(error_name(error.code).data()),
                                    py::str(section_name(error.section).data()), error.offset);
  PyErr_SetObject(type.ptr(), exception.ptr());
  throw py::error_already_set();
}

/// The value of `result`; raises its error.
template <class T>
T value_or_raise(Result<T> result) {
  if (!result) raise(result.error());
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

}  // namespace hmlfc::python
