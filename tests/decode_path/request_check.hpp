// Requests of callers: parts of views, and what is not there; and what every check here needs.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include <hmlfc/decoder.hpp>

namespace hmlfc::vectors {

/// What is wrong with a vector.
class Mismatch : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws `what` unless the condition holds.
inline void demand(bool condition, const std::string& what) {
  if (!condition) throw Mismatch(what);
}

/// The values of `part` of `values`, rows of `width`, row by row; `part` lies in them.
template <class T>
std::vector<T> part_of(const std::vector<T>& values, size_t width, const Rect& part) {
  std::vector<T> found;
  for (size_t y = part.y; y < size_t{part.y} + part.height; ++y) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(y * width + part.x);
    found.insert(found.end(), begin, begin + part.width);
  }
  return found;
}

/// Checks that `decoder` refuses blocks, parts, levels and refinements that its stream does not
/// have, and that a part of a view is that part of it. Throws Mismatch.
void check_requests(const Decoder& decoder);

}  // namespace hmlfc::vectors
