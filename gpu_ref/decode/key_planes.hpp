// The planes of key images as the reference area holds them (shaders/reference_samples.glsl).
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "stream_shape.hpp"

namespace hmlfc::gpu {

/// Decodes all planes of key images, on all cores, and gives each to `use`, in the order of the
/// area: `word`, the first of the plane in the area, and its bytes. A plane that does not decode is
/// all samples of its error. Returns how many did not.
size_t pack_key_planes(
    const StreamView& stream, const StreamShapeRecord& shape,
    const std::function<void(uint64_t word, std::span<const uint8_t> bytes)>& use);

}  // namespace hmlfc::gpu
