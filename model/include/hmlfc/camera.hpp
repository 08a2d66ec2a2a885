// A virtual camera in front of a light field, and the integer record that renderers take
// (docs/rendering.md, sections 1 and 2).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

#include <hmlfc/export.hpp>
#include <hmlfc/format.hpp>

namespace hmlfc {

/// Which pixels of which views a pixel of a frame is the weighted mean of (SMP-1, SMP-2).
enum class Filter : uint8_t {
  kNearest = 0,       ///< the nearest pixel of the nearest view
  kViews = 1,         ///< the nearest pixels of the views around the ray
  kQuadrilinear = 2,  ///< four pixels of each of the views around the ray
};

/// Where a frame takes the scene to be (section 9).
enum class GeometrySource : uint8_t {
  kPlane = 0,   ///< in the focal plane
  kStream = 1,  ///< where the disparity maps of the stream say
};

/// "plane" or "stream".
constexpr std::string_view geometry_name(GeometrySource geometry) {
  return geometry == GeometrySource::kPlane ? "plane" : "stream";
}

/// What suits a light field of this header: its maps where the stream has shared disparities, which
/// say most of where things are (GEO-6), else the plane.
inline GeometrySource suitable_geometry(const StreamHeader& header) {
  return header.has(Feature::kSharedDisparity) ? GeometrySource::kStream : GeometrySource::kPlane;
}

inline constexpr int kMaxAperture = 3;      ///< of Camera::aperture
inline constexpr int kMaxFrameSide = 4096;  ///< of frame_width and frame_height, pixels

/// "nearest", "views" or "quadrilinear".
constexpr std::string_view filter_name(Filter filter) {
  constexpr std::string_view kNames[] = {"nearest", "views", "quadrilinear"};
  return kNames[static_cast<size_t>(filter)];
}

/// A point in the units of CAM-1.
struct WorldPoint {
  double u = 0;  ///< column of views
  double v = 0;  ///< row of views
  double z = 0;  ///< distance beyond the view plane (< 0: behind it), in columns of views
};

/// The inputs of CAM-3. with_defaults fills in those not set.
struct Camera {
  std::optional<uint32_t> frame_width;   ///< pixels, [1, 4096]; else that of a view
  std::optional<uint32_t> frame_height;  ///< pixels, [1, 4096]; else that of a view
  std::optional<double> focal;      ///< of the views, pixels, [1, 65536]; else max(width, height)
  double shear = 0;                 ///< disparity at infinity, pixels a column, [-256, 256]
  std::optional<double> row_pitch;  ///< distance of two rows in columns, +-[1/16, 127/16]; else
                                    ///< row_scale / 16 of the header if that is not 0, else 1
  std::optional<WorldPoint> position;  ///< u, v in [-4096, 8192], z and z / row_pitch in
                                       ///< [-4096, 4096]; else the middle of the grid, z = 0
  std::optional<WorldPoint> look_at;   ///< each in [-2^20, 2^20]; else straight ahead
  std::optional<double> tan_half;      ///< of half the field of view along the longer side,
                                       ///< [2^-10, 2]; else the largest frame that a view fills
  double focus = 0;                    ///< disparity of the focal plane, [-256, 256]
  int aperture = 0;  ///< log2 of the steps of views over which a weight falls to 0, [0, 3]
  Filter filter = Filter::kQuadrilinear;             ///< of the frame's pixels
  GeometrySource geometry = GeometrySource::kPlane;  ///< of frames with aperture 0
};

/// `camera` with every input set, for a light field of this header: inputs not given take the last
/// column of CAM-3. A camera at a view's place with nothing else set takes the view itself (SMP-4).
HMLFC_EXPORT Camera with_defaults(const Camera& camera, const StreamHeader& header);

/// A vector of integers.
struct IntVector {
  int32_t x = 0;  ///< along the columns of views
  int32_t y = 0;  ///< along the rows of views
  int32_t z = 0;  ///< into the scene

  friend bool operator==(const IntVector&, const IntVector&) = default;
};

/// All that a frame's pixels depend on besides the light field's samples (REC-2): the fields of its
/// table in their order, without gaps. A direction n is n_hi * 2^-28 + n_lo * 2^-40.
struct FrameRecord {
  int32_t frame_width = 1;   ///< pixels, [1, 4096]
  int32_t frame_height = 1;  ///< pixels, [1, 4096]
  int32_t filter = 0;        ///< a Filter
  int32_t aperture = 0;      ///< [0, 3]
  IntVector n0_hi;           ///< direction of the frame's centre
  IntVector n0_lo;           ///< [0, 4095] each
  IntVector na_hi;           ///< its change for half a pixel to the right
  IntVector na_lo;           ///< [0, 4095] each
  IntVector nb_hi;           ///< its change for half a pixel down
  IntVector nb_lo;           ///< [0, 4095] each
  int32_t u0 = 0;            ///< position of the camera, 2^-16 steps of views
  int32_t v0 = 0;            ///< the same for rows
  int32_t zu = 0;            ///< its distance beyond the view plane, 2^-16 columns
  int32_t zv = 0;            ///< the same in rows
  int32_t x0 = 0;            ///< where the ray straight ahead meets view (r0, c0), 2^-12 pixels
  int32_t y0 = 0;            ///< the same for y
  int32_t gain = 0;          ///< 2^-12 pixels for a slope of 1
  int32_t dx = 0;            ///< 2^-12 pixels for each column of views
  int32_t dy = 0;            ///< 2^-12 pixels for each row of views
  int32_t c0 = 0;            ///< the column nearest to the camera
  int32_t r0 = 0;            ///< the row nearest to the camera
  int32_t cols = 1;          ///< of views
  int32_t rows = 1;          ///< of views
  int32_t width = 1;         ///< of a view, pixels
  int32_t height = 1;        ///< of a view, pixels
  int32_t geometry = 0;      ///< 1: the frame has geometry (SRF-1)
  int32_t focus = 0;         ///< of the focal plane, 2^-8 pixels a column
  int32_t pitch = 256;       ///< of the rows of views, 2^-8 columns
  int32_t fine = 0;          ///< disparities nearer to 0 count as 0, 2^-8 pixels a column, [0, 256]

  friend bool operator==(const FrameRecord&, const FrameRecord&) = default;
};
static_assert(sizeof(FrameRecord) == 164);

/// The inputs of CAM-3 in its order, as CameraError names them.
inline constexpr std::string_view kCameraInputs[] = {
    "frame_width", "frame_height", "focal", "shear",    "row_pitch", "position",
    "look_at",     "tan_half",     "focus", "aperture", "filter",    "geometry"};

/// Why a camera takes no frame.
struct CameraError {
  std::string message;     ///< one line for people: the input and its interval
  std::string_view input;  ///< one of kCameraInputs; a literal
};

/// The record of `camera` in front of a light field of this header (CAM-3, CAM-4, REC-1 to REC-3):
/// the same integers on every machine. Errors: an input outside its interval, a camera that looks
/// along the columns of views, or one too far away.
HMLFC_EXPORT tl::expected<FrameRecord, CameraError> frame_record(const Camera& camera,
                                                                 const StreamHeader& header);

/// First and last row, first and last column, of the views that the rays through the corners of the
/// frame of `record` take pixels from (RAY-3, SMP-1), and all between them. In floating point, for
/// a map on the screen or for decoding ahead; geometry may need further views.
HMLFC_EXPORT std::array<int, 4> views_in_use(const FrameRecord& record);

}  // namespace hmlfc
