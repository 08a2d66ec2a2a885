// A frame and the buffers of its blocks: the layout of shaders/frame.glsl.
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
  uint64_t pixels = 0;
  uint64_t pool = 0;
  uint32_t pool_chunk_log2 = 0;
  uint32_t pool_pages = 0;
  uint32_t kept_pages = 0;
  uint32_t stop_level = 0;
  uint32_t capacity = 0;
  uint32_t needed_words = 0;
  FrameRecord record;
};

/// Words of the counters that the host uses.
enum FrameCounter : uint32_t {
  kCountNeeded = 0,
  kCountMode = 4,
  kCountDecoded = 5,
  kCountPages = 6,
  kCountFirstError = 9,
  kCountStatus = 10,
  kCountWalk = 11,
  kCountSamples = 14,
  kCountErrors = 17,
  kFrameCounters = 20,  ///< those before are of one frame
  kCountUsedPages = 20,
  kAllCounters = 21,
};

inline constexpr uint32_t kModeNoRoom = 0;  ///< of kCountMode

}  // namespace hmlfc::gpu
