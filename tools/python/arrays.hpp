// Numbers of the library as NumPy arrays.
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

/// (height, width, 3), uint8 at depth 8, else uint16.
inline pybind11::array array_of(const RgbImage& image) {
  std::vector<pybind11::ssize_t> shape{image.height, image.width, 3};
  const auto& samples = image.samples;
  if (image.depth > 8) return array_of(std::vector<uint16_t>(samples), std::move(shape));
  return array_of(std::vector<uint8_t>(samples.begin(), samples.end()), std::move(shape));
}

}  // namespace hmlfc::python
