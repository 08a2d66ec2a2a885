// What the decoder in WGSL needs besides a stream: a browser has no decoder of JPEG 2000.
#pragma once

#include <cstdint>
#include <vector>

#include <hmlfc/decoder.hpp>
#include <hmlfc/gpu/device.hpp>

namespace hmlfc {
struct StreamView;
}

namespace hmlfc::gpu {

/// The shape of the stream, the decoded key images and the list of the other reference images,
/// which hmlfc_gpu.js decodes. Needs no device. In words of 32 bits, the low byte first: the
/// numbers that `HEADER` of hmlfc_gpu.js names, StreamShape (stream_shape.glsl), each batch of
/// reference images: areas, requests, and its areas (arguments.glsl); each run of words of the
/// reference area: first word, words, and these words. Failure: kLimit, a stream or area of 4 GiB
/// or more.
Outcome<std::vector<uint8_t>> reference_area(const Decoder& stream);

/// The same, for this project's own programs.
Outcome<std::vector<uint8_t>> reference_area(const StreamView& stream);

}  // namespace hmlfc::gpu
