// The renderers of this project behind one function.
#pragma once

#include <functional>
#include <span>
#include <string>

#include <tl/expected.hpp>

#include <hmlfc/decoder.hpp>
#include <hmlfc/renderer.hpp>

#include "accuracy/frame_setting.hpp"

namespace hmlfc::bench {

/// Draws the frame of a record down to a stop level, or says why not.
using DrawFrame =
    std::function<tl::expected<void, std::string>(const FrameRecord&, int stop_level, Frame&)>;

/// The renderer of a setting for the stream `file`, which `decoder` has opened; both must outlive
/// it. Errors: backend gpu without a device.
tl::expected<DrawFrame, std::string> open_backend(const FrameSetting& setting,
                                                  std::span<const uint8_t> file,
                                                  const Decoder& decoder);

}  // namespace hmlfc::bench
