// A frame on the device: the layout and the numbers of shaders/frame.glsl.
#pragma once

#include <cstdint>

#include <hmlfc/camera.hpp>

namespace hmlfc::gpu {

struct FrameShape {
  uint64_t needed = 0;
  uint64_t held = 0;
  uint64_t pages = 0;
  uint64_t slots = 0;
  uint64_t counters = 0;
  uint64_t used_pages = 0;
  uint64_t results = 0;
  uint64_t dispatches = 0;
  uint64_t drawn = 0;
  uint64_t rays = 0;
  uint64_t displacements = 0;
  uint64_t disparities = 0;
  uint64_t looked_up = 0;
  uint64_t pool = 0;
  uint32_t pool_chunk_log2 = 0;
  uint32_t pool_pages = 0;
  uint32_t kept_pages = 0;
  uint32_t stop_level = 0;
  uint32_t capacity = 0;
  uint32_t needed_words = 0;
  uint32_t forget = 0;
  FrameRecord record;
};

using uint = uint32_t;
#include "shaders/shared_numbers.glsl"

}  // namespace hmlfc::gpu
