#include <cmath>
#include <stdexcept>

#include <hmlfc/camera.hpp>

#include "camera_case.hpp"
#include "render/disparity_value.hpp"
#include "render/surface.hpp"
#include "render/taps.hpp"

namespace hmlfc::stress {
namespace {

StreamHeader light_field(uint32_t cols, uint32_t rows, uint32_t side) {
  StreamHeader header;
  header.cols = cols;
  header.rows = rows;
  header.width = side;
  header.height = side;
  return header;
}

// A camera at `position` that looks along `direction`, before a light field of square pixels.
Camera looking(const WorldPoint& position, const WorldPoint& direction, uint32_t frame_width,
               uint32_t frame_height, double tan_half) {
  Camera camera;
  camera.frame_width = frame_width;
  camera.frame_height = frame_height;
  camera.focal = 1;
  camera.row_pitch = 1;
  camera.position = position;
  camera.look_at = {position.u + direction.u, position.v + direction.v, position.z + direction.z};
  camera.tan_half = tan_half;
  return camera;
}

constexpr uint32_t kSide = kMaxFrameSide;
constexpr WorldPoint kOrigin{};

// In the last pixel of a row, or the first, abs(n.x) = 4 * n.z - 1, and n.z * r is so close below
// 2^57 that the slope is the largest, or the smallest, possible. Found by trying directions along
// which abs(n.x) is about 4 * n.z.
constexpr double kSteepTanHalf = 1.984375;
constexpr WorldPoint kSteepRight{95593, 0, 423676};
constexpr WorldPoint kSteepLeft{-90425, 0, 400771};

Camera steep(const WorldPoint& position, const WorldPoint& direction) {
  return looking(position, direction, kSide, 1, kSteepTanHalf);
}

// The light field is to have a single view: every ray is among the views then.
Camera far_picture(double column, double distance, double focal) {
  Camera camera = steep({column, 0, distance}, kSteepLeft);
  camera.shear = 256;
  camera.focus = -256;
  camera.focal = focal;
  return camera;
}

// Runs cameras and records.
class Extremes {
 public:
  explicit Extremes(const std::function<void(const std::string&)>& done) : done_(done) {}

  void take(const std::string& name, const Camera& camera, const StreamHeader& header) {
    take(name, record_of(name, camera, header));
  }

  void take(const std::string& name, const FrameRecord& record) {
    for (const int32_t j : {0, record.frame_height / 2, record.frame_height - 1}) {
      for (const int32_t i : {0, record.frame_width / 2, record.frame_width - 1}) {
        const auto ray = trace(record, i, j);
        if (!ray) continue;
        for (const int32_t e : {kLeastD, 0, kGreatestD}) {
          for_each_view_taps(record, *ray, e, [](const ViewTaps&) {});
        }
      }
    }
    done_(name);
  }

  static FrameRecord record_of(const std::string& name, const Camera& camera,
                               const StreamHeader& header) {
    const auto record = frame_record(camera, header);
    if (!record) throw std::logic_error(name + ": " + record.error().message);
    return *record;
  }

 private:
  const std::function<void(const std::string&)>& done_;
};

// RAY-1 and RAY-2.
void take_directions(Extremes& extremes, const StreamHeader& header) {
  // Forward, right and down add to n.z as 1 : 2 : 2, and their roundings all add up.
  const WorldPoint longest{89637, 268852, 100222};
  const WorldPoint backwards{-longest.u, -longest.v, -longest.z};
  extremes.take("longest direction", looking(kOrigin, longest, kSide, kSide, 2), header);
  extremes.take("longest direction backwards", looking(kOrigin, backwards, kSide, kSide, 2),
                header);
  extremes.take("shortest n.z", looking(kOrigin, {std::sqrt(15.0), 0, 1}, 1, 1, 1), header);
  // na_lo.z = nb_lo.z = 4095, n0_lo.z = 4095 and 0. Found by trying.
  extremes.take("greatest low parts",
                looking(kOrigin, {90, 935, 496}, kSide, kSide, 767367892 * 0x1p-31), header);
  extremes.take("least low parts",
                looking(kOrigin, {821, 132, 949}, kSide, kSide, 179750945 * 0x1p-31), header);
  extremes.take("greatest slope", steep(kOrigin, kSteepRight), header);
}

// RAY-3 and RAY-4 of cameras.
void take_places(Extremes& extremes, const StreamHeader& header) {
  extremes.take("far right of the views", steep({8192, 8192, 4096}, kSteepLeft), header);
  extremes.take("far left of the views", steep({-4096, -4096, -4096}, kSteepLeft), header);
  extremes.take("far right in the picture", far_picture(128, 65537.0 / 512, 1), header);
  extremes.take("far left in the picture", far_picture(-128, 0, 65536), header);
}

// x(c) where gain, x0 and dx * (c - c0) are each as large as REC-3 allows. No camera has all three:
// where gain * sx and dx * (cols - 1) are that large, x0 has the other sign.
void take_records(Extremes& extremes) {
  const StreamHeader header = light_field(513, 1, 1);
  const std::string name = "record at the limits of REC-3";
  FrameRecord record = Extremes::record_of(name, steep(kOrigin, kSteepLeft), header);
  record.u0 = (record.cols - 1) << 16;
  for (const int32_t sign : {1, -1}) {
    record.x0 = sign * (1 << 28);
    record.gain = -sign * (1 << 28);
    record.dx = sign * (1 << 20);
    extremes.take(name, record);
  }
}

// SMP-1 and SMP-2.
void take_samples(Extremes& extremes) {
  Camera corner = looking(kOrigin, {0, 0, 1}, kSide, kSide, 32767.75 / 65536 * 4096 / 4095);
  corner.focal = 65536;
  extremes.take("corners of the largest view", corner, light_field(1, 1, 65536));
  for (const double place : {1.0, 1 + 1.0 / 256}) {
    extremes.take("between four views", looking({place, place, 0}, {0, 0, 1}, 1, 1, 1),
                  light_field(3, 3, 16));
  }
}

// GEO-4 to GEO-6: the largest vectors and baselines, the longest and the shortest.
void take_geometry(const std::function<void(const std::string&)>& done) {
  for (const int32_t d : {-4096, 4095}) static_cast<void>(scaled_disparity(d, 0, 4096));
  for (const int32_t d : {-4096, 0}) static_cast<void>(scaled_disparity(d, 5, d == 0 ? 1 : 4096));
  done("disparities at the ends of their interval");
  const Span longest{16 * 4095, 127 * 4095};
  for (const int32_t u : {-1016, 1016}) {
    for (const Span& baseline : {longest, Span{-longest.x, -longest.y}, Span{0, 1}}) {
      static_cast<void>(vector_disparity({u, u}, baseline));
      static_cast<void>(is_along({u, -u}, baseline));
    }
  }
  static_cast<void>(vector_disparity({0, 0}, {0, 1}));
  static_cast<void>(is_along({0, 0}, {0, 1}));
  done("vectors along the longest and the shortest baseline");
}

// SRF-2 and SRF-3: what a view with the least weight of all adds to the places at the limits of
// REC-3, one step of rows away.
void take_surfaces(const std::function<void(const std::string&)>& done) {
  constexpr int32_t kFocus = 1 << 16;
  constexpr int32_t kPitch = 127 << 4;
  constexpr int32_t kRow = 512;
  constexpr int32_t kSteps = 4088;  // of 2^-12
  static_cast<void>(displacement_in_view(0, 0, (kSteps - 1) * 16));
  FrameRecord record{};
  record.focus = kFocus;
  static_cast<void>(displacement_of({kLeastD, 1}, record));
  record.focus = -kFocus;
  static_cast<void>(displacement_of({kGreatestD, 1}, record));
  Ray ray;
  ray.vs = (kRow * 4096 - kSteps) * 16;
  for (const int32_t sign : {1, -1}) {
    record.dy = sign * (1 << 20);
    ray.yb = sign * ((1 << 28) + (1 << 30) - 1);
    const int32_t g = displacement_a_row(kLeastD, -sign * kPitch);
    static_cast<void>(y_in_view(record, ray, g, kRow));
  }
  done("surfaces farthest from the focal plane");
}

}  // namespace

void run_frame_extremes(const std::function<void(const std::string& name)>& done) {
  Extremes extremes(done);
  const StreamHeader one_pixel = light_field(1, 1, 1);
  take_directions(extremes, one_pixel);
  take_places(extremes, one_pixel);
  take_records(extremes);
  take_samples(extremes);
  take_geometry(done);
  take_surfaces(done);
}

}  // namespace hmlfc::stress
