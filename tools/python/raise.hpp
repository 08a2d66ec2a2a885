// Errors as Python exceptions.
#pragma once

#include <regex>
#include <string>
#include <utility>

#include <hmlfc/error.hpp>

#include "io/io_error.hpp"
#include "python/object.hpp"

namespace hmlfc::python {

/// A message as Python has it, whatever bytes the file names in it have: what it says of options of
/// the program, such as --grid 3x4, it says of arguments, grid=(3, 4).
inline Object message_of(const std::string& text) {
  static const std::pair<std::regex, const char*> kArguments[] = {
      {std::regex(R"(--grid (\w{1,9})x(\w{1,9}))"), "grid=($1, $2)"},
      {std::regex("--(names|order) '"), "$1='"},
      {std::regex("--(names|grid|order)"), "$1"},
      {std::regex("--no-rig"), "rig=False"},
  };
  std::string said = text;
  for (const auto& [option, argument] : kArguments) said = regex_replace(said, option, argument);
  return Object(PyUnicode_DecodeFSDefaultAndSize(said.data(), std::ssize(said)));
}

/// Raises hmlfc.Error for `error`; needs the GIL.
[[noreturn]] inline void raise(const Error& error) {
  if (error.code == ErrorCode::kOutOfMemory) throw std::bad_alloc();
  const Object package(PyImport_ImportModule("hmlfc"));
  const Object type(PyObject_GetAttrString(package.get(), "Error"));
  const Object arguments =
      tuple_of(to_string(error), error_name(error.code), section_name(error.section), error.offset);
  const Object exception(PyObject_CallObject(type.get(), arguments.get()));
  PyErr_SetObject(type.get(), exception.get());
  throw Raised();
}

/// Raises OSError for `error`, FileNotFoundError and its like where the system gave a number.
[[noreturn]] inline void raise(const io::IoError& error) {
  if (error.out_of_memory) throw std::bad_alloc();
  const Object message = message_of(error.message);
  const Object arguments =
      error.error_number == 0 ? message : tuple_of(error.error_number, message);
  PyErr_SetObject(PyExc_OSError, arguments.get());
  throw Raised();
}

/// The value of `result`; raises its error.
template <class T, class E>
T value_or_raise(tl::expected<T, E> result) {
  if (!result) raise(result.error());
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

}  // namespace hmlfc::python
