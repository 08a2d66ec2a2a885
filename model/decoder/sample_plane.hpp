// A dense plane of samples.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hmlfc {

/// width x height samples, row-major. Samples of depth 12 and their residuals fit in 16 bits
/// (specification, section 11).
struct SamplePlane {
  uint32_t width = 0;
  uint32_t height = 0;
  std::vector<int16_t> samples;

  SamplePlane() = default;
  SamplePlane(uint32_t w, uint32_t h) : width(w), height(h), samples(size_t{w} * h) {}

  std::span<int16_t> row(uint32_t y) { return {samples.data() + size_t{y} * width, width}; }
  std::span<const int16_t> row(uint32_t y) const {
    return {samples.data() + size_t{y} * width, width};
  }
  int16_t at(uint32_t x, uint32_t y) const { return samples[size_t{y} * width + x]; }
};

}  // namespace hmlfc
