// A stream written piece by piece, so that it need not fit in memory.
#pragma once

#include <cstdint>
#include <span>

#include <hmlfc/code_storage.hpp>
#include <hmlfc/format.hpp>

#include "encoder/coded_images.hpp"

namespace hmlfc {

/// Hands the whole file to `sink`, in order; `header` without its section table, `rig` the section
/// RIG where `header` has camera_rig. In memory are ROOT, GROUP, the table of TOP and one image.
void write_stream(const StreamHeader& header, const CodedImages& images,
                  std::span<const uint8_t> rig, const ByteSink& sink);

}  // namespace hmlfc
