// What a frame has on the device for itself.
#pragma once

#include <cstdint>
#include <span>

#include <hmlfc/gpu/renderer.hpp>

#include "arithmetic/rounding.hpp"
#include "decode/batch.hpp"
#include "device/arguments.hpp"
#include "device/commands.hpp"
#include "render/surface.hpp"

namespace hmlfc::gpu {

/// What the commands of a frame depend on. Where it changes, they are recorded again.
struct FrameForm {
  int32_t width = 0;
  int32_t height = 0;
  uint32_t stop_level = 0;
  bool geometry = false;
  FrameOutput output = FrameOutput::kDevice;
  uint64_t room = 0;         ///< counts how often the buffers that frames share were made anew
  uint32_t texel_bytes = 0;  ///< of the picture (texels.glsl); 0: it has lanes of 16 bits

  friend bool operator==(const FrameForm&, const FrameForm&) = default;

  /// Groups of pixels of mark.comp and render.comp.
  uint32_t columns() const { return ceil_div(static_cast<uint32_t>(width), kGroupPixels); }
  uint32_t rows() const { return ceil_div(static_cast<uint32_t>(height), kGroupPixels); }

  /// Cells of surface.comp.
  uint64_t cells() const {
    return uint64_t{static_cast<uint32_t>(cells_along(width))} *
           static_cast<uint32_t>(cells_along(height));
  }

  /// Pixels of a row of the picture as render.comp writes it: with lanes, an even number.
  uint64_t row_pixels() const {
    const auto pixels = static_cast<uint64_t>(width);
    return texel_bytes == 0 ? 2 * ceil_div(pixels, uint64_t{2}) : pixels;
  }
  uint64_t drawn_bytes() const {
    return (texel_bytes == 0 ? kPixelBytes : texel_bytes) * row_pixels() *
           static_cast<uint64_t>(height);
  }

  static constexpr uint64_t kPixelBytes = 6;  ///< of three lanes
};

class FrameBuffers {
 public:
  explicit FrameBuffers(Device::State& device);

  /// Makes room for a frame of `form`, and sets the addresses in arguments().
  void prepare(Device::State& device, const FrameForm& form);

  /// What the kernels read; the host sets the rest before write_arguments().
  FrameArguments& arguments() { return arguments_; }
  const Buffer& arguments_buffer() const { return arguments_buffer_; }

  /// Hands arguments() as it is now to the next run.
  void write_arguments();

  /// Writes copies that bring the arguments, and the counters at their first values, to the device.
  void write_upload(Commands& commands) const;

  /// The counters of a frame that is done, as the host reads them, and its error.
  const Buffer& results() const { return results_; }
  std::span<const uint32_t> counters() const { return results_.records<const uint32_t>(); }
  ErrorCode status() const;

  /// The picture.
  const Buffer& drawn() const { return drawn_.get(); }

 private:
  FrameArguments arguments_;
  Buffer upload_;  // as arguments_buffer_, then counters_
  Buffer arguments_buffer_;
  Buffer counters_;
  Buffer results_;
  GrowingBuffer drawn_{Memory::kDevice};
  GrowingBuffer rays_{Memory::kDevice};
  GrowingBuffer displacements_{Memory::kDevice};
};

}  // namespace hmlfc::gpu
