// Streams and cameras for comparisons of frames of the GPU renderer.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gpu/render_pair.hpp"
#include "stimulus/random_stream.hpp"

namespace hmlfc::gpu {

/// Walks through `frames` frames, now and then at another level; returns the first difference, or
/// nothing.
std::string difference_of_walk(RenderPair& pair, uint32_t seed, int frames, FrameTally& tally);

/// Draws frames with geometry of scenes in depth of `seeds` seeds; returns the first difference, or
/// nothing.
std::string difference_of_scenes(Device& device, uint32_t seeds, tb::Damage damage,
                                 uint64_t cache_bytes, FrameTally& tally);

/// Twelve frames of 40 x 30, every second with geometry, which need more than 20 blocks each, none
/// of them with an error.
std::vector<FrameRecord> small_frames(const Decoder& stream);

/// 2 x 2 views of 300 x 200 pixels in blocks of 2 x 2: more blocks in a frame than there is room
/// for at first.
std::vector<uint8_t> stream_of_many_blocks();

}  // namespace hmlfc::gpu
