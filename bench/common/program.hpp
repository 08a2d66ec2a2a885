// Errors of the benchmark programs: they throw, and end with a message.
#pragma once

#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include <fmt/format.h>
#include <tl/expected.hpp>

namespace hmlfc::bench {

/// The value of `made`, or std::runtime_error with the message of its error.
template <class Value, class Failure>
Value value_of(tl::expected<Value, Failure> made) {
  if (!made) {
    if constexpr (requires { made.error().message; }) {
      throw std::runtime_error(made.error().message);
    } else {
      throw std::runtime_error(to_string(made.error()));
    }
  }
  if constexpr (!std::is_void_v<Value>) return std::move(*made);
}

/// body() as main of the program `name`. Exit status: that of body, 2 std::invalid_argument, 1 any
/// other exception; both print their message.
template <class Body>
int run_program(const char* name, const Body& body) {
  try {
    return body();
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", name, error.what());
    return dynamic_cast<const std::invalid_argument*>(&error) != nullptr ? 2 : 1;
  }
}

}  // namespace hmlfc::bench
