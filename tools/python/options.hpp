// Keyword arguments of functions with many.
#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

namespace hmlfc::python {

/// Reads arguments by name; the package passes all that are read. What is raised names them.
class Options {
 public:
  explicit Options(const pybind11::kwargs& given) : given_(given) {}

  /// The argument `name` as a T. Raises TypeError, or ValueError for a number that T cannot hold;
  /// either says what is `wanted`.
  template <class T>
  T get(const char* name, const std::string& wanted = "") const {
    const pybind11::object value = given_[name];
    try {
      return value.cast<T>();
    } catch (const pybind11::cast_error&) {
      const std::string says =
          name + (" cannot be " + pybind11::repr(value).cast<std::string>()) + wanted;
      if (PyNumber_Check(value.ptr()) != 0) throw pybind11::value_error(says);
      throw pybind11::type_error(says);
    }
  }

  /// The same of a number, or None, which lies in [least, most].
  template <class T>
  std::optional<T> get(const char* name, int64_t least, int64_t most) const {
    const auto value = get<std::optional<T>>(name);
    if (!value || (*value >= static_cast<T>(least) && *value <= static_cast<T>(most))) return value;
    throw pybind11::value_error(name + (" lies in [" + std::to_string(least)) + ", " +
                                std::to_string(most) + "]");
  }

  /// (rows, columns), each in [1, most], or None.
  std::optional<std::pair<uint32_t, uint32_t>> pair(const char* name, uint32_t most) const {
    const auto value = get<std::optional<std::pair<uint32_t, uint32_t>>>(name);
    if (!value || (std::min(value->first, value->second) >= 1 &&
                   std::max(value->first, value->second) <= most)) {
      return value;
    }
    throw pybind11::value_error(name +
                                (" is (rows, columns), each in [1, " + std::to_string(most)) + "]");
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
    throw pybind11::value_error(std::string(name) + " is one of " + names + ", not '" + value +
                                "'");
  }

 private:
  const pybind11::kwargs& given_;
};

}  // namespace hmlfc::python
