#include "encoder/subpel_prediction.hpp"

namespace hmlfc {

void interpolate(const PaddedPlane& reference, const Area& area, const SubpelVector& vector,
                 int32_t* out) {
  const ptrdiff_t stride = reference.stride();
  const int16_t* row = reference.at(area.x + vector.ix, area.y + vector.iy);
  const int32_t right = vector.fx;
  const int32_t left = 8 - right;
  const int32_t below = vector.fy;
  const int32_t above = 8 - below;
  for (int32_t j = 0; j < area.height; ++j, row += stride, out += area.width) {
    const int16_t* next = row + stride;
    if (right == 0 && below == 0) {
      for (int32_t i = 0; i < area.width; ++i) out[i] = 64 * row[i];
    } else if (below == 0) {
      for (int32_t i = 0; i < area.width; ++i) out[i] = 8 * (left * row[i] + right * row[i + 1]);
    } else if (right == 0) {
      for (int32_t i = 0; i < area.width; ++i) out[i] = 8 * (above * row[i] + below * next[i]);
    } else {
      for (int32_t i = 0; i < area.width; ++i) {
        out[i] = above * (left * row[i] + right * row[i + 1]) +
                 below * (left * next[i] + right * next[i + 1]);
      }
    }
  }
}

void combine(const int32_t* first, const int32_t* second, int32_t samples, int32_t* out) {
  if (second == nullptr) {
    for (int32_t i = 0; i < samples; ++i) out[i] = (first[i] + 32) >> 6;
  } else {
    for (int32_t i = 0; i < samples; ++i) out[i] = (first[i] + second[i] + 64) >> 7;
  }
}

}  // namespace hmlfc
