// The structures of hmlfc.h that grow: read and written by the size that the caller knows.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <type_traits>

#include "capi/outcome.hpp"

namespace hmlfc::capi {

/// Whether a structure of `struct_size` bytes has member `last`.
template <class T, class Member>
bool reaches(size_t struct_size, Member T::*last) {
  const T example{};
  const auto* begin = reinterpret_cast<const std::byte*>(&example);
  const auto* end = reinterpret_cast<const std::byte*>(&(example.*last) + 1);
  return struct_size >= static_cast<size_t>(end - begin);
}

/// A copy of *from, the argument `name`. `last` is the last member that the first version of the
/// structure had: all callers know it. Members that the caller does not know are 0. Refuses null, a
/// size without `last`, and bytes other than 0 of members that this library does not know.
template <class T, class Member>
tl::expected<T, Refusal> read_struct(const T* from, Member T::*last, const char* name) {
  static_assert(std::is_trivially_copyable_v<T>);
  if (from == nullptr) return bad_argument(name, "is null");
  const size_t size = from->struct_size;
  if (!reaches(size, last)) return bad_argument(name, "has too small a struct_size");
  T copy{};
  std::memcpy(&copy, from, std::min(size, sizeof(T)));
  const auto* bytes = reinterpret_cast<const unsigned char*>(from);
  for (size_t at = sizeof(T); at < size; ++at) {
    if (bytes[at] != 0) return bad_argument(name, "has members that this library does not know");
  }
  return copy;
}

/// Reads as read_struct() does; null stands for all members 0.
template <class T, class Member>
tl::expected<T, Refusal> read_options(const T* from, Member T::*last, const char* name) {
  if (from == nullptr) return T{};
  return read_struct(from, last, name);
}

/// Copies to `to` the members that its struct_size says it has; those that this library does not
/// know become 0. struct_size stays.
template <class T>
void write_struct(const T& from, T& to) {
  static_assert(std::is_trivially_copyable_v<T>);
  const size_t size = to.struct_size;
  const size_t known = std::min(size, sizeof(T));
  auto* bytes = reinterpret_cast<unsigned char*>(&to);
  std::memcpy(bytes, &from, known);
  for (size_t at = known; at < size; ++at) bytes[at] = 0;
  to.struct_size = size;
}

}  // namespace hmlfc::capi
