#include <algorithm>
#include <array>
#include <cmath>

#include <hmlfc/camera.hpp>

namespace hmlfc {

namespace {

// The first and the last of `count` views whose weight is above 0 for places from `least` to
// `greatest`, where weights fall to 0 over 2^aperture steps.
std::array<int, 2> weighted(double least, double greatest, int aperture, int count) {
  const double steps = std::exp2(aperture);
  const double last = count - 1;
  const double from = std::clamp(least, 0.0, last);
  const double to = std::clamp(greatest, 0.0, last);
  return {static_cast<int>(std::max(0.0, std::floor(from - steps) + 1)),
          static_cast<int>(std::min(last, std::ceil(to + steps) - 1))};
}

}  // namespace

std::array<int, 4> views_in_use(const FrameRecord& record) {
  double least[2] = {1e9, 1e9};
  double greatest[2] = {-1e9, -1e9};
  for (const int a : {1 - record.frame_width, record.frame_width - 1}) {
    for (const int b : {1 - record.frame_height, record.frame_height - 1}) {
      const auto along = [a, b](int32_t n0, int32_t na, int32_t nb) {
        return n0 + static_cast<double>(a) * na + static_cast<double>(b) * nb;
      };
      const double z = std::max(1.0, along(record.n0_hi.z, record.na_hi.z, record.nb_hi.z));
      const double sx = along(record.n0_hi.x, record.na_hi.x, record.nb_hi.x) / z;
      const double sy = along(record.n0_hi.y, record.na_hi.y, record.nb_hi.y) / z;
      const double place[2] = {(record.v0 - record.zv * sy) / 65536,
                               (record.u0 - record.zu * sx) / 65536};
      for (int k = 0; k < 2; ++k) {
        least[k] = std::min(least[k], place[k]);
        greatest[k] = std::max(greatest[k], place[k]);
      }
    }
  }
  const auto rows = weighted(least[0], greatest[0], record.aperture, record.rows);
  const auto cols = weighted(least[1], greatest[1], record.aperture, record.cols);
  return {rows[0], rows[1], cols[0], cols[1]};
}

}  // namespace hmlfc
