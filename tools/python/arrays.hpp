// Pictures of the library as NumPy arrays.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>

#include <hmlfc/image.hpp>

namespace hmlfc::python {

/// An array that takes over `values`, not a copy; `shape` has as many elements.
template <class T>
pybind11::array array_of(std::vector<T> values, std::vector<pybind11::ssize_t> shape) {
  auto owner = std::make_unique<std::vector<T>>(std::move(values));
  T* data = owner->data();
  const pybind11::capsule capsule(
      owner.release(), [](void* vector) { delete static_cast<std::vector<T>*>(vector); });
  return pybind11::array_t<T>(std::move(shape), data, capsule);
}

/// The samples of `image` in the type of its arrays: bytes at depth 8. Without the GIL.
inline std::vector<uint8_t> bytes_of(const RgbImage& image) {
  return {image.samples.begin(), image.samples.end()};
}

/// (height, width, 3), uint8 at depth 8, else uint16. `bytes` is bytes_of(image) at depth 8.
inline pybind11::array array_of(RgbImage image, std::vector<uint8_t> bytes) {
  std::vector<pybind11::ssize_t> shape{image.height, image.width, 3};
  if (image.depth == 8) return array_of(std::move(bytes), std::move(shape));
  return array_of(std::move(image.samples), std::move(shape));
}

}  // namespace hmlfc::python
