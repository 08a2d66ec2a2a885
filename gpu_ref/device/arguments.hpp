// The arguments of the kernels and the records that they read: the layouts and numbers of
// shaders/arguments.glsl, frame.glsl and shared_numbers.glsl.
#pragma once

#include <cstdint>

#include <hmlfc/camera.hpp>

namespace hmlfc::gpu {

/// Push constants. Addresses are device addresses of buffers.
struct Arguments {
  uint64_t shape = 0;
  uint64_t stream = 0;
  uint64_t references = 0;
  uint64_t areas = 0;
  uint64_t requests = 0;
  uint64_t entries = 0;
  uint64_t statuses = 0;
  uint64_t samples = 0;
  uint64_t stages = 0;
  uint64_t damage = 0;
  uint64_t colour_areas = 0;
  uint64_t pixels = 0;
  uint64_t pixel_statuses = 0;
  uint32_t area_count = 0;
  uint32_t request_count = 0;
  uint32_t colour_area_count = 0;
  uint32_t pixel_count = 0;
  uint64_t frame = 0;
};
static_assert(sizeof(Arguments) == 128, "every Vulkan device takes 128 bytes of push constants");

/// Area of arguments.glsl.
struct AreaRecord {
  uint32_t first_request = 0;
  uint32_t row = 0;
  uint32_t col = 0;
  uint32_t plane = 0;
  uint32_t level = 0;
  uint32_t bx = 0;
  uint32_t by = 0;
  uint32_t columns = 1;
  uint32_t exact = 0;
  uint32_t pad[3] = {};
};

/// ColourArea of arguments.glsl.
struct ColourAreaRecord {
  uint32_t first_block = 0;
  uint32_t columns = 1;
  uint32_t bx = 0;
  uint32_t by = 0;
  uint32_t luma = 0;
  uint32_t co = 0;
  uint32_t cg = 0;
  uint32_t chroma_bx = 0;
  uint32_t chroma_by = 0;
  uint32_t chroma_columns = 1;
  uint32_t first_texel = 0;
  uint32_t pad = 0;
};

inline constexpr uint32_t kRequestBytes = 12;  ///< Request of arguments.glsl
inline constexpr uint32_t kEntryWords = 8;     ///< ENTRY_WORDS of block_entry.glsl
inline constexpr uint32_t kStageCount = 4;     ///< stages of samples.comp

/// Frame of frame.glsl: what Arguments::frame points to. Addresses as there.
struct FrameArguments {
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
