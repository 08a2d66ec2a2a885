// What a frame has for itself on the device.
#pragma once

#include <cstdint>
#include <span>

#include <hmlfc/gpu/renderer.hpp>

#include "arithmetic/rounding.hpp"
#include "batch_buffers.hpp"
#include "frame_shape.hpp"
#include "recorder.hpp"
#include "render/surface.hpp"

namespace hmlfc::gpu {

/// What the commands of a frame depend on: they are recorded anew where it changes.
struct FrameForm {
  int32_t width = 0;
  int32_t height = 0;
  uint32_t stop_level = 0;
  bool geometry = false;
  FrameOutput output = FrameOutput::kDevice;
  uint64_t room = 0;         ///< counts how often the buffers that frames share were made anew
  uint32_t texel_bytes = 0;  ///< the picture is of texels (texels.glsl); 0: of lanes of 16 bits

  friend bool operator==(const FrameForm&, const FrameForm&) = default;

  /// Groups of pixels of mark.comp and render.comp.
  uint32_t columns() const { return ceil_div(static_cast<uint32_t>(width), kGroupPixels); }
  uint32_t rows() const { return ceil_div(static_cast<uint32_t>(height), kGroupPixels); }

  /// Cells of surface.comp.
  uint64_t cells() const {
    return uint64_t{static_cast<uint32_t>(cells_along(width))} *
           static_cast<uint32_t>(cells_along(height));
  }

  /// Pixels of a row of the picture as render.comp writes it: of lanes, an even number.
  uint64_t row_pixels() const {
    const auto pixels = static_cast<uint64_t>(width);
    return texel_bytes == 0 ? 2 * ceil_div(pixels, uint64_t{2}) : pixels;
  }
  uint64_t drawn_bytes() const {
    return (texel_bytes == 0 ? kPixelBytes : texel_bytes) * row_pixels() *
           static_cast<uint64_t>(height);
  }

  static constexpr uint64_t kPixelBytes = 6;  ///< of lanes
};

class FrameBuffers {
 public:
  explicit FrameBuffers(Device::State& device);

  /// Makes room for a frame of `form`, and writes the part of shape() that says where.
  void prepare(Device::State& device, const FrameForm& form);

  /// What the kernels know of the frame.
  FrameShape& shape() { return shape_; }
  const Buffer& shape_buffer() const { return shape_buffer_; }

  /// shape() as it is now is what the next run brings to the device.
  void write_shape();

  /// Records that shape and counters, these at their first values, come to the device.
  void record_upload(Recorder& commands) const;

  /// The counters of a frame that is done, for the host.
  const Buffer& results() const { return results_; }
  std::span<const uint32_t> counters() const { return results_.records<const uint32_t>(); }

  /// The picture.
  const Buffer& drawn() const { return drawn_.get(); }

 private:
  FrameShape shape_;
  Buffer upload_;  // as shape_buffer_, then counters_
  Buffer shape_buffer_;
  Buffer counters_;
  Buffer results_;
  GrowingBuffer drawn_{Memory::kDevice};
  GrowingBuffer rays_{Memory::kDevice};
  GrowingBuffer displacements_{Memory::kDevice};
};

}  // namespace hmlfc::gpu
