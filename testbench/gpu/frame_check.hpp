// Frames of the GPU renderer against those of the golden renderer.
#pragma once

#include <optional>
#include <span>
#include <string>

#include <hmlfc/gpu/renderer.hpp>

#include "syntax/stream_view.hpp"

namespace hmlfc::gpu {

/// What was compared.
struct FrameCheck {
  uint64_t frames = 0;
  uint64_t needed = 0;   ///< blocks, NED-1
  uint64_t decoded = 0;  ///< of them
  std::optional<std::string> mismatch{};
};

/// Renders the frames of records_of_path(). Each must have the golden renderer's bytes, blocks and
/// error; stops at the first difference. `file` and `stream` are those that `renderer` has open.
Outcome<FrameCheck> check_frames(GpuRenderer& renderer, std::span<const uint8_t> file,
                                 const StreamView& stream, const Camera& camera, uint64_t frames);

}  // namespace hmlfc::gpu
