// The renderer of a setting of the accuracy report.
#pragma once

#include <memory>
#include <string>

#include <tl/expected.hpp>

#include <hmlfc/decoder.hpp>
#include <hmlfc/renderer.hpp>

#include "accuracy/frame_setting.hpp"

namespace hmlfc::bench {

/// The renderer of `setting` for the stream of `decoder`, which must outlive it. Errors: backend
/// gpu without a device.
tl::expected<std::unique_ptr<FrameRenderer>, std::string> open_backend(const FrameSetting& setting,
                                                                       const Decoder& decoder);

}  // namespace hmlfc::bench
