#include "render/row_taps.hpp"

namespace hmlfc {

AxisRun::AxisRun(size_t row_pixels) : row_pixels_(row_pixels) {}

void AxisRun::reserve(int32_t count) {
  for (int32_t k = 0; k < count; ++k) {
    if (!first[k].empty()) continue;
    for (auto* array : {&first[k], &fraction[k], &weight[k]}) array->resize(row_pixels_);
  }
}

}  // namespace hmlfc
