// Numbers of the library as NumPy arrays.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <hmlfc/image.hpp>

#include "python/object.hpp"

namespace hmlfc::python {

/// A new array of T, whose samples are to be written to data(), row by row.
template <class T>
class Array {
 public:
  explicit Array(const std::vector<size_t>& shape) : object_(made(shape)) {}

  T* data() { return static_cast<T*>(bytes_.view().buf); }
  size_t size() const { return static_cast<size_t>(bytes_.view().len) / sizeof(T); }
  const Object& object() const { return object_; }

 private:
  static Object made(const std::vector<size_t>& shape) {
    const std::string type = (std::is_signed_v<T> ? "int" : "uint") + std::to_string(8 * sizeof(T));
    const Object numpy(PyImport_ImportModule("numpy"));
    return Object(
        PyObject_CallMethod(numpy.get(), "empty", "Os", object_of(shape).get(), type.c_str()));
  }

  Object object_;
  Buffer bytes_{object_.get(), PyBUF_WRITABLE};
};

/// `shape` has as many elements as `values`, whose type the array has.
template <class T, class U>
Object array_of(const std::vector<U>& values, const std::vector<size_t>& shape) {
  Array<T> array(shape);
  std::transform(values.begin(), values.end(), array.data(),
                 [](U value) { return static_cast<T>(value); });
  return array.object();
}

/// (height, width, 3), uint8 at depth 8, else uint16.
inline Object array_of(const RgbImage& image) {
  const std::vector<size_t> shape{image.height, image.width, 3};
  if (image.depth > 8) return array_of<uint16_t>(image.samples, shape);
  return array_of<uint8_t>(image.samples, shape);
}

}  // namespace hmlfc::python
