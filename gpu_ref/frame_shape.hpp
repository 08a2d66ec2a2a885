// A frame and the buffers of its blocks: the layout of shaders/frame.glsl.
#pragma once

#include <cstdint>

#include <hmlfc/camera.hpp>

namespace hmlfc::gpu {

struct FrameShape {
  uint64_t needed = 0;
  uint64_t first_slots = 0;
  uint64_t counters = 0;
  uint64_t pixels = 0;
  uint32_t stop_level = 0;
  uint32_t capacity = 0;
  uint32_t needed_words = 0;
  FrameRecord record;
};

/// Words of the counters.
enum FrameCounter : uint32_t {
  kCountNeeded = 0,
  kCountFirstError = 1,
  kCountStatus = 2,
  kCountWalk = 3,
  kCountSamples = 6,
  kCountErrors = 9,
  kFrameCounters = 12,
};

}  // namespace hmlfc::gpu
