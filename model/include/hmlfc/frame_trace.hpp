// The stages of one pixel of a frame (docs/rendering.md), for those who write a renderer.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <hmlfc/camera.hpp>
#include <hmlfc/decoder.hpp>
#include <hmlfc/error.hpp>
#include <hmlfc/export.hpp>

namespace hmlfc {

/// A number of a stage, named as in docs/rendering.md.
struct FrameValue {
  std::string_view name;    ///< "U", "x(c, E)"; a literal
  int64_t value = 0;        ///< in the unit of its clause
  std::string_view clause;  ///< that defines it, "RAY-3"; a literal
};

/// What one step of a renderer computes.
struct FrameStage {
  /// "ray" of the pixel; with geometry before it "cell ray", a "proposal" for each view with weight
  /// and "cell"; then a "view" for each view with weight, and "sum"; a literal.
  std::string_view name;
  std::optional<ViewPos> view{};   ///< of a "proposal" or "view"
  std::vector<FrameValue> values;  ///< in the order in which they are computed
};

/// All stages of a pixel, in their order. A ray that is outside ends with "outside" = 1, whose
/// clause is the one by which it is, and has no views.
struct FrameTrace {
  std::vector<FrameStage> stages;   ///< at least one
  std::array<int32_t, 3> sample{};  ///< R, G, B of the frame: [0, 2^depth - 1]
};

/// The names of the integers of FrameRecord in their order, such as "n0_hi.x" (REC-2).
HMLFC_EXPORT std::array<std::string_view, sizeof(FrameRecord) / 4> frame_record_names();

/// The integers of `record` in the same order.
HMLFC_EXPORT std::array<int32_t, sizeof(FrameRecord) / 4> frame_record_values(
    const FrameRecord& record);

/// What the golden renderer computes for pixel (`x`, `y`) of the frame of `record`, from views
/// decoded down to `stop_level` (DEC-1). Errors: that of NED-2 among the blocks of this pixel;
/// bad_request where record or stop_level do not fit the light field, or the frame has no such
/// pixel.
HMLFC_EXPORT Result<FrameTrace> frame_trace(const Decoder& decoder, const FrameRecord& record,
                                            int stop_level, uint32_t x, uint32_t y);

}  // namespace hmlfc
