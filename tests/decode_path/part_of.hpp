// Rectangles of rows of values.
#pragma once

#include <cstddef>
#include <vector>

#include <hmlfc/decoder.hpp>

namespace hmlfc::vectors {

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

}  // namespace hmlfc::vectors
