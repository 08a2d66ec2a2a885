// The arguments of the kernels and the records they read: the layouts of shaders/arguments.glsl.
#pragma once

#include <cstdint>

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

}  // namespace hmlfc::gpu
