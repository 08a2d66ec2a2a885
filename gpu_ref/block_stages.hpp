// What the debug variant leaves of a block, as records.
#pragma once

#include <cstdint>
#include <span>

#include "batch_buffers.hpp"
#include "gpu_decoder.hpp"

namespace hmlfc::gpu {

/// The stages of one block with status `status`. `entries` begins with its entries
/// (block_entry.glsl), `stages` with its stages (samples.comp).
BlockStages block_stages(uint32_t status, std::span<const uint32_t> entries,
                         std::span<const uint32_t> stages, const BlockSizes& sizes);

}  // namespace hmlfc::gpu
