// Arguments of the module's functions, all of which have names.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "python/object.hpp"

namespace hmlfc::python {

/// What can be called.
struct Function {
  Object object{Py_NewRef(Py_None)};
};

/// read(from, to): whether `from` is a T, which `to` becomes. Clears what was raised.
inline bool nothing_raised() {
  const bool nothing = PyErr_Occurred() == nullptr;
  PyErr_Clear();
  return nothing;
}

inline bool read(PyObject* from, bool& to) {
  to = PyObject_IsTrue(from) == 1;
  return nothing_raised();
}

template <std::integral T>
bool read(PyObject* from, T& to) {
  PyObject* index = PyNumber_Index(from);
  if (index == nullptr) return nothing_raised();
  const Object number(index);
  if constexpr (std::is_unsigned_v<T>) {
    const auto value = PyLong_AsUnsignedLongLong(number.get());
    to = static_cast<T>(value);
    return nothing_raised() && std::in_range<T>(value);
  } else {
    const auto value = PyLong_AsLongLong(number.get());
    to = static_cast<T>(value);
    return nothing_raised() && std::in_range<T>(value);
  }
}

inline bool read(PyObject* from, double& to) {
  to = PyFloat_AsDouble(from);
  return nothing_raised();
}

inline bool read(PyObject* from, std::string& to) {
  Py_ssize_t size = 0;
  char* bytes = nullptr;
  const char* text = nullptr;
  if (PyBytes_Check(from) && PyBytes_AsStringAndSize(from, &bytes, &size) == 0) text = bytes;
  if (PyUnicode_Check(from)) text = PyUnicode_AsUTF8AndSize(from, &size);
  if (text != nullptr) to.assign(text, static_cast<size_t>(size));
  return nothing_raised() && text != nullptr;
}

inline bool read(PyObject* from, Function& to) {
  to.object = Object(Py_NewRef(from));
  return PyCallable_Check(from) != 0;
}

template <class T>
bool read_item(PyObject* sequence, size_t at, T& to) {
  PyObject* item = PySequence_GetItem(sequence, static_cast<Py_ssize_t>(at));
  if (item == nullptr) return nothing_raised();
  return read(Object(item).get(), to);
}

inline size_t size_of(PyObject* sequence) {
  const Py_ssize_t size = PySequence_Check(sequence) != 0 ? PySequence_Size(sequence) : -1;
  return nothing_raised() ? static_cast<size_t>(size) : SIZE_MAX;
}

template <class T, class U>
bool read(PyObject* from, std::pair<T, U>& to) {
  return size_of(from) == 2 && read_item(from, 0, to.first) && read_item(from, 1, to.second);
}

/// An array, of as many, or a vector, of any number.
template <class List>
requires requires(List list) { list.front(); }
bool read(PyObject* from, List& to) {
  const size_t size = size_of(from);
  if constexpr (requires { to.resize(size); }) {
    if (size == SIZE_MAX) return false;
    to.resize(size);
  }
  if (size != to.size()) return false;
  for (size_t i = 0; i < size; ++i) {
    if (!read_item(from, i, to[i])) return false;
  }
  return true;
}

template <class T>
bool read(PyObject* from, std::optional<T>& to) {
  return Py_IsNone(from) != 0 || read(from, to.emplace());
}

/// Whether this is a number, or a list of such, of lists down to `depth`.
inline bool has_numbers(PyObject* value, int depth) {
  if (PyNumber_Check(value) != 0) return true;
  if (depth == 0 || PyUnicode_Check(value)) return false;
  const Py_ssize_t size = PySequence_Size(value);
  bool all = nothing_raised();
  for (Py_ssize_t i = 0; all && i < size; ++i) {
    all = has_numbers(Object(PySequence_GetItem(value, i)).get(), depth - 1);
  }
  return all;
}

/// Reads arguments by name; the package passes all that are read. What is raised names them.
class Options {
 public:
  explicit Options(PyObject* given) : given_(given) {}

  /// The argument `name` itself.
  PyObject* object(const char* name) const {
    PyObject* value = given_ != nullptr ? PyDict_GetItemString(given_, name) : nullptr;
    if (value == nullptr) throw Raised(PyExc_TypeError, std::string(name) + " is missing");
    return value;
  }

  /// The argument `name` as a T. Raises TypeError, or ValueError for numbers that T cannot hold;
  /// either says what is `wanted`.
  template <class T>
  T get(const char* name, const std::string& wanted = "") const {
    PyObject* value = object(name);
    T result{};
    if (read(value, result)) return result;
    std::string shown;
    read(Object(PyObject_Repr(value)).get(), shown);
    throw Raised(has_numbers(value, 2) ? PyExc_ValueError : PyExc_TypeError,
                 name + (" cannot be " + shown) + wanted);
  }

  /// What hold() made of a T.
  template <class T>
  T& held(const char* name) const {
    void* value = PyCapsule_GetPointer(object(name), T::kName);
    if (value == nullptr) throw Raised();
    return *static_cast<T*>(value);
  }

  /// The same of a number, or None, which lies in [least, most].
  template <class T>
  std::optional<T> get(const char* name, int64_t least, int64_t most) const {
    const auto value = get<std::optional<T>>(name);
    if (!value || (*value >= static_cast<T>(least) && *value <= static_cast<T>(most))) return value;
    throw Raised(PyExc_ValueError,
                 name + (" lies in [" + std::to_string(least)) + ", " + std::to_string(most) + "]");
  }

  /// (rows, columns), each in [1, most], or None.
  std::optional<std::pair<uint32_t, uint32_t>> pair(const char* name, uint32_t most) const {
    const auto value = get<std::optional<std::pair<uint32_t, uint32_t>>>(name);
    if (!value || (std::min(value->first, value->second) >= 1 &&
                   std::max(value->first, value->second) <= most)) {
      return value;
    }
    throw Raised(PyExc_ValueError,
                 name + (" is (rows, columns), each in [1, " + std::to_string(most)) + "]");
  }

  /// The meaning of the text `name`, one of `choices`.
  template <class T>
  T choice(const char* name, std::initializer_list<std::pair<const char*, T>> choices) const {
    const auto value = get<std::string>(name);
    std::string names;
    for (const auto& [text, meaning] : choices) {
      if (value == text) return meaning;
      names += (names.empty() ? "'" : ", '") + std::string(text) + "'";
    }
    throw Raised(PyExc_ValueError,
                 std::string(name) + " is one of " + names + ", not '" + value + "'");
  }

 private:
  PyObject* given_;
};

/// A function of the module, whose exceptions become Python's.
template <Object (*kFunction)(const Options&)>
PyObject* called(PyObject*, PyObject*, PyObject* given) {
  try {
    return kFunction(Options(given)).release();
  } catch (const Raised& raised) {
    raised.raise_again();
  } catch (const std::bad_alloc&) {
    PyErr_NoMemory();
  } catch (const std::exception& exception) {
    PyErr_SetString(PyExc_RuntimeError, exception.what());
  }
  return nullptr;
}

/// A row of the module's table of functions.
template <Object (*kFunction)(const Options&)>
PyMethodDef method(const char* name) {
  const auto function = reinterpret_cast<void (*)()>(&called<kFunction>);
  return {name, reinterpret_cast<PyCFunction>(function), METH_VARARGS | METH_KEYWORDS, nullptr};
}

}  // namespace hmlfc::python
