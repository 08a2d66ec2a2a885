// The real frame of docs/rendering.md, section 7.
#include <hmlfc/renderer.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "decoder/open_stream.hpp"
#include "decoder/request_guard.hpp"
#include "render/displaced_cells.hpp"
#include "render/shown_image.hpp"

namespace hmlfc {
namespace {

// The clauses of sections 1 to 4 in real numbers.
class RealRenderer {
 public:
  RealRenderer(const Decoder& decoder, const Camera& camera, int stop_level)
      : decoder_(decoder),
        header_(decoder.header()),
        camera_(with_defaults(camera, header_)),
        stop_level_(stop_level),
        pitch_(*camera_.row_pitch),
        kappa_(camera_.shear - camera_.focus) {
    const WorldPoint& p = *camera_.position;
    const WorldPoint& q = *camera_.look_at;
    const double gx = q.u - p.u;
    const double gy = pitch_ * (q.v - p.v);
    const double gz = q.z - p.z;
    const double length = std::sqrt(gx * gx + gy * gy + gz * gz);
    fx_ = gx / length;
    fy_ = gy / length;
    fz_ = gz / length;
    h_ = std::sqrt(fx_ * fx_ + fz_ * fz_);
  }

  Result<RealFrame> run() {
    RealFrame frame;
    displaced_ = golden_displacements(decoder_, *frame_record(camera_, header_), stop_level_);
    for (const int32_t e : displaced_.cells) {
      frame.max_displacement =
          std::max(frame.max_displacement, std::abs(e) / double{kDisparityUnits});
    }
    frame.width = *camera_.frame_width;
    frame.height = *camera_.frame_height;
    for (uint32_t j = 0; j < frame.height; ++j) {
      for (uint32_t i = 0; i < frame.width; ++i) {
        const auto ray = trace(i, j);
        Colour colour{};
        if (ray) {
          auto mixed = mix(*ray, pixels_displacement(i, j));
          if (!mixed) return tl::unexpected(mixed.error());
          colour = *mixed;
        }
        frame.inside.push_back(ray ? 1 : 0);
        frame.samples.insert(frame.samples.end(), colour.begin(), colour.end());
      }
    }
    return frame;
  }

 private:
  using Colour = std::array<double, 3>;

  struct Ray {
    double u, v;    // clamped to the grid
    double us, vs;  // up to half a step beyond it (SRF-2)
    double sx, sy;  // slopes
  };

  struct Tap {
    uint32_t at;
    double weight;
  };

  // RAY-1 to RAY-5.
  std::optional<Ray> trace(uint32_t i, uint32_t j) const {
    const double longer = std::max(*camera_.frame_width, *camera_.frame_height);
    const double a = (2.0 * i + 1 - *camera_.frame_width) * *camera_.tan_half / longer;
    const double b = (2.0 * j + 1 - *camera_.frame_height) * *camera_.tan_half / longer;
    const double rx = fz_ / h_;
    const double rz = -fx_ / h_;
    const double nx = fx_ + a * rx + b * fy_ * rz;
    const double ny = fy_ + b * (fz_ * rx - fx_ * rz);
    const double nz = fz_ + a * rz - b * fy_ * rx;
    if (nz < 0.25 || std::abs(nx) >= 4 * nz || std::abs(ny) >= 4 * nz) return std::nullopt;
    Ray ray{0, 0, 0, 0, nx / nz, ny / nz};
    const WorldPoint& p = *camera_.position;
    if (!place(p.u - p.z * ray.sx, header_.cols, ray.u, ray.us)) return std::nullopt;
    if (!place(p.v - p.z / pitch_ * ray.sy, header_.rows, ray.v, ray.vs)) return std::nullopt;
    const double x = x_in(ray, std::floor(ray.u + 0.5));
    const double y = y_in(ray, std::floor(ray.v + 0.5));
    if (x < -0.5 || x >= header_.width - 0.5 || y < -0.5 || y >= header_.height - 0.5) {
      return std::nullopt;
    }
    return ray;
  }

  static bool place(double at, uint32_t views, double& inside, double& displaced) {
    if (views > 1 && (at < -0.5 || at > views - 0.5)) return false;
    inside = std::clamp(at, 0.0, views - 1.0);
    displaced = std::clamp(at, -0.5, views - 0.5);
    return true;
  }

  // RAY-4, with CAM-2: x(c) of the point where the ray meets the focal plane.
  double x_in(const Ray& ray, double col) const {
    const WorldPoint& p = *camera_.position;
    return (header_.width - 1) / 2.0 + kappa_ * (p.u - col) +
           camera_.shear * (col - (header_.cols - 1) / 2.0) +
           (*camera_.focal - kappa_ * p.z) * ray.sx;
  }

  double y_in(const Ray& ray, double row) const {
    const WorldPoint& p = *camera_.position;
    return (header_.height - 1) / 2.0 + pitch_ * kappa_ * (p.v - row) +
           pitch_ * camera_.shear * (row - (header_.rows - 1) / 2.0) +
           (*camera_.focal - kappa_ * p.z) * ray.sy;
  }

  // SMP-1 on one axis.
  std::vector<Tap> views_at(double at, uint32_t views) const {
    if (camera_.filter == Filter::kNearest) {
      return {{static_cast<uint32_t>(std::floor(at + 0.5)), 1}};
    }
    const int steps = 1 << camera_.aperture;
    std::vector<Tap> taps;
    const int below = static_cast<int>(std::floor(at));
    for (int m = below - steps + 1; m <= below + steps; ++m) {
      const double weight = (steps - std::abs(m - at)) / (steps * steps);
      const int inside = std::clamp(m, 0, static_cast<int>(views) - 1);
      if (weight > 0) taps.push_back({static_cast<uint32_t>(inside), weight});
    }
    return taps;
  }

  // SMP-2 on one axis.
  std::vector<Tap> pixels_at(double at, uint32_t size) const {
    const double inside = std::clamp(at, 0.0, size - 1.0);
    if (camera_.filter != Filter::kQuadrilinear) {
      return {{static_cast<uint32_t>(std::floor(inside + 0.5)), 1}};
    }
    const double below = std::floor(inside);
    std::vector<Tap> taps{{static_cast<uint32_t>(below), 1 - (inside - below)}};
    if (inside > below) taps.push_back({static_cast<uint32_t>(below) + 1, inside - below});
    return taps;
  }

  // Returns the displacement of a pixel's cell, in pixels a column.
  double pixels_displacement(uint32_t i, uint32_t j) const {
    return displaced_.at(static_cast<int32_t>(i), static_cast<int32_t>(j)) /
           double{kDisparityUnits};
  }

  // SMP-3, with SRF-2 for displacement `e`.
  Result<Colour> mix(const Ray& ray, double e) {
    Colour sum{};
    for (const Tap& row : views_at(ray.v, header_.rows)) {
      for (const Tap& col : views_at(ray.u, header_.cols)) {
        const auto view = view_at({row.at, col.at});
        if (!view) return tl::unexpected(view.error());
        for (const Tap& y :
             pixels_at(y_in(ray, row.at) + pitch_ * e * (row.at - ray.vs), header_.height)) {
          for (const Tap& x : pixels_at(x_in(ray, col.at) + e * (col.at - ray.us), header_.width)) {
            const uint16_t* pixel =
                (*view)->samples.data() + (size_t{y.at} * header_.width + x.at) * 3;
            const double weight = row.weight * col.weight * y.weight * x.weight;
            for (size_t k = 0; k < 3; ++k) sum[k] += weight * pixel[k];
          }
        }
      }
    }
    return sum;
  }

  Result<const RgbImage*> view_at(ViewPos at) {
    const ViewPos shown = first_view_of(header_, at, stop_level_);
    const uint64_t key = uint64_t{shown.row} * header_.cols + shown.col;
    const auto found = views_.find(key);
    if (found != views_.end()) return &found->second;
    auto view = decoder_.decode_view(shown, stop_level_);
    if (!view) return tl::unexpected(view.error());
    return &views_.emplace(key, std::move(*view)).first->second;
  }

  const Decoder& decoder_;
  const StreamHeader& header_;
  Camera camera_;
  int stop_level_;
  double pitch_;
  double kappa_;
  double fx_, fy_, fz_, h_;
  CellDisplacements displaced_;
  std::map<uint64_t, RgbImage> views_;
};

}  // namespace

Result<RealFrame> render_real(const Decoder& decoder, const Camera& camera, int stop_level) {
  return guard_request(DecoderAccess::stream(decoder).source,
                       [&] { return RealRenderer(decoder, camera, stop_level).run(); });
}

double fixed_point_bound(const Camera& camera, const StreamHeader& header,
                         double max_displacement) {
  const Camera full = with_defaults(camera, header);
  const WorldPoint& p = *full.position;
  const double pitch = *full.row_pitch;
  const double kappa = full.shear - full.focus;
  const double ds = 0x1p-22;
  const double max_distance = std::max(header.rows, header.cols) - 1.0;
  const double place = 7 * 0x1p-17 + std::abs(p.z) * std::max(1.0, std::abs(1 / pitch)) * ds;
  const double ex = (7 + max_distance) * 0x1p-13 + std::abs(*full.focal - kappa * p.z) * ds;
  const double displaced = max_displacement == 0 ? 0
                                                 : std::max(1.0, std::abs(pitch)) *
                                                           max_displacement * (0x1p-11 + place) +
                                                       0x1p-8 * (max_displacement + 1) + 0x1p-12;
  const double eu = std::ldexp(1.0, full.aperture - 9) + place;
  const double peak = (1 << header.depth) - 1;
  return 0.5 + 1.0 / 32 + peak * (2 * eu + 2 * (0x1p-9 + ex + displaced));
}

double mean_squared_error(const RgbImage& frame, const RealFrame& real) {
  double sum = 0;
  for (size_t i = 0; i < real.samples.size(); ++i) {
    const double difference = frame.samples[i] - real.samples[i];
    sum += difference * difference;
  }
  return sum / static_cast<double>(real.samples.size());
}

}  // namespace hmlfc
