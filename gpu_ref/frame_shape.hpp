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

/// Words of the counters.
enum FrameCounter : uint32_t {
  kCountNeeded = 0,
  kCountNeededPages = 1,
  kCountMissing = 2,
  kCountMissingPages = 3,
  kCountMode = 4,
  kCountDecoded = 5,
  kCountPages = 6,
  kCountRequests = 7,
  kCountNextPage = 8,
  kCountFirstError = 9,
  kCountStatus = 10,
  kCountWorkgroups = 11,
  kCountLookedUp = 12,
  kFrameCounters = 13,
};

inline constexpr uint32_t kNoError = ~0u;  ///< of kCountFirstError

/// Pixels of a group of mark.comp and render.comp, each way (shaders/pixel_group.glsl).
inline constexpr uint32_t kGroupPixels = 8;

/// Words of the sizes of dispatches that frame_plan.glsl decides, three each.
enum FrameDispatch : uint32_t {
  kDispatchWalk = 0,
  kDispatchSamples = 3,
  kAllDispatches = 6,
};

/// Values of kCountMode.
enum FrameMode : uint32_t { kModeNoRoom = 0, kModeAdd = 1, kModeFlush = 2 };

}  // namespace hmlfc::gpu
