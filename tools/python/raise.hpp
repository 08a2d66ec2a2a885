// Errors as Python exceptions.
#pragma once

#include <regex>
#include <string>
#include <utility>

#include <pybind11/pybind11.h>

#include <hmlfc/error.hpp>

#include "io/io_error.hpp"

namespace hmlfc::python {

/// A message as Python has it, whatever bytes the file names in it have: what it says of options of
/// the program, such as --grid 3x4, it says of arguments, grid=(3, 4).
inline pybind11::str message_of(const std::string& text) {
  static const std::pair<std::regex, const char*> kArguments[] = {
      {std::regex(R"(--grid (\w{1,9})x(\w{1,9}))"), "grid=($1, $2)"},
      {std::regex("--(names|order) '"), "$1='"},
      {std::regex("--(names|grid|order)"), "$1"},
      {std::regex("--no-rig"), "rig=False"},
  };
  std::string said = text;
  for (const auto& [option, argument] : kArguments) said = regex_replace(said, option, argument);
  return pybind11::reinterpret_steal<pybind11::str>(
      PyUnicode_DecodeFSDefaultAndSize(said.data(), static_cast<Py_ssize_t>(said.size())));
}

/// Raises hmlfc.Error for `error`; needs the GIL.
[[noreturn]] inline void raise(const Error& error) {
  if (error.code == ErrorCode::kOutOfMemory) throw std::bad_alloc();
  namespace py = pybind11;
  const py::object type = py::module_::import("hmlfc").attr("Error");
  const py::object exception = type(to_string(error), py::str(error_name(error.code).data()),
                                    py::str(section_name(error.section).data()), error.offset);
  PyErr_SetObject(type.ptr(), exception.ptr());
  throw pybind11::error_already_set();
}

/// Raises OSError for `error`, FileNotFoundError and its like where the system gave a number.
[[noreturn]] inline void raise(const io::IoError& error) {
  if (error.out_of_memory) throw std::bad_alloc();
  const pybind11::str message = message_of(error.message);
  const pybind11::object arguments = error.error_number == 0
                                         ? pybind11::object(message)
                                         : pybind11::make_tuple(error.error_number, message);
  PyErr_SetObject(PyExc_OSError, arguments.ptr());
  throw pybind11::error_already_set();
}

/// The value of `result`; raises its error.
template <class T, class E>
T value_or_raise(tl::expected<T, E> result) {
  if (!result) raise(result.error());
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

}  // namespace hmlfc::python
