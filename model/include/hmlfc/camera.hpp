// A virtual camera before a light field, and the integer record that renderers take
// (docs/rendering.md, sections 1 and 2).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

#include <hmlfc/export.hpp>
#include <hmlfc/format.hpp>

namespace hmlfc {

/// How the pixels of views make a pixel of a frame (SMP-1, SMP-2).
enum class Filter : uint8_t {
  kNearest = 0,       ///< the nearest pixel of the nearest view
  kBilinear = 1,      ///< the nearest pixels of the views around the ray
  kQuadrilinear = 2,  ///< four pixels of each of the views around the ray
};

inline constexpr int kMaxAperture = 3;
inline constexpr int kMaxFrameSide = 4096;

/// "nearest", "bilinear" or "quadrilinear".
constexpr std::string_view filter_name(Filter filter) {
  constexpr std::string_view kNames[] = {"nearest", "bilinear", "quadrilinear"};
  return kNames[static_cast<size_t>(filter)];
}

/// A point in columns, rows and, beyond the view plane, columns of views (CAM-1).
struct WorldPoint {
  double u = 0;
  double v = 0;
  double z = 0;
};

/// The inputs of CAM-3; its table has the intervals, and what stands for those not given.
struct Camera {
  std::optional<uint32_t> frame_width;
  std::optional<uint32_t> frame_height;
  std::optional<double> focal;
  double shear = 0;
  std::optional<double> row_pitch;
  std::optional<WorldPoint> position;
  std::optional<WorldPoint> look_at;
  std::optional<double> tan_half;
  double focus = 0;
  int aperture = 0;
  Filter filter = Filter::kQuadrilinear;
};

/// `camera` with every input set: CAM-3's last column for a light field of this header. A camera at
/// a view's place with nothing else set takes the view itself (SMP-4).
HMLFC_EXPORT Camera with_defaults(const Camera& camera, const StreamHeader& header);

/// A vector of integers.
struct IntVector {
  int32_t x = 0;
  int32_t y = 0;
  int32_t z = 0;

  friend bool operator==(const IntVector&, const IntVector&) = default;
};

/// Everything that a frame's pixels depend on but the light field's samples (REC-2): the fields of
/// its table in their order, without gaps.
struct FrameRecord {
  int32_t frame_width = 1;
  int32_t frame_height = 1;
  int32_t filter = 0;
  int32_t aperture = 0;
  IntVector n0_hi, n0_lo;
  IntVector na_hi, na_lo;
  IntVector nb_hi, nb_lo;
  int32_t u0 = 0;
  int32_t v0 = 0;
  int32_t zu = 0;
  int32_t zv = 0;
  int32_t x0 = 0;
  int32_t y0 = 0;
  int32_t gain = 0;
  int32_t dx = 0;
  int32_t dy = 0;
  int32_t c0 = 0;
  int32_t r0 = 0;
  int32_t cols = 1;
  int32_t rows = 1;
  int32_t width = 1;
  int32_t height = 1;

  friend bool operator==(const FrameRecord&, const FrameRecord&) = default;
};
static_assert(sizeof(FrameRecord) == 148);

/// Why a camera takes no frame: the input and its interval, for people.
struct CameraError {
  std::string message;
};

/// The record of `camera` before a light field of this header (CAM-3, CAM-4, REC-1 to REC-3): the
/// same integers on every machine. Errors: an input outside its interval, a camera that looks along
/// the columns of views, or one too far away.
HMLFC_EXPORT tl::expected<FrameRecord, CameraError> frame_record(const Camera& camera,
                                                                 const StreamHeader& header);

}  // namespace hmlfc
