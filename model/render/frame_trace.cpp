#include <hmlfc/frame_trace.hpp>

#include <bit>
#include <utility>

#include <hmlfc/disparity.hpp>

#include "decoder/open_stream.hpp"
#include "decoder/request_guard.hpp"
#include "render/golden_blocks.hpp"
#include "render/ray.hpp"
#include "render/shown_image.hpp"
#include "render/surface.hpp"
#include "render/taps.hpp"

namespace hmlfc {
namespace {

using Integers = std::array<int32_t, sizeof(FrameRecord) / 4>;

// Computes a pixel as the golden renderer does, and keeps every number.
class FrameTracer {
 public:
  FrameTracer(const Decoder& decoder, const FrameRecord& record, int stop_level)
      : decoder_(decoder), record_(record), stop_level_(stop_level), blocks_(decoder, stop_level) {}

  Result<FrameTrace> trace(int32_t i, int32_t j) {
    const int32_t e =
        has_geometry(record_, stop_level_) ? displacement(i >> kCellLog2, j >> kCellLog2) : 0;
    const auto ray =
        add_ray("ray", 2 * i + 1 - record_.frame_width, 2 * j + 1 - record_.frame_height);
    if (!ray) return std::move(found_);
    for_each_view_taps(record_, *ray, e, [&](const ViewTaps& taps) { blocks_.need(taps); });
    if (auto ok = blocks_.decode(); !ok) return tl::unexpected(ok.error());
    std::array<uint32_t, 3> sums{};
    for_each_view_taps(record_, *ray, e, [&](const ViewTaps& taps) {
      const Rgb q = add_view(*ray, e, taps);
      for (size_t k = 0; const int32_t part : {q.r, q.g, q.b}) {
        sums[k++] += taps.weight * static_cast<uint32_t>(part);
      }
    });
    add_sums(sums);
    return std::move(found_);
  }

 private:
  void begin(std::string_view stage, std::optional<ViewPos> view = std::nullopt) {
    found_.stages.push_back({stage, view, {}});
  }

  void add(std::string_view name, int64_t value, std::string_view clause) {
    found_.stages.back().values.push_back({name, value, clause});
  }

  std::nullopt_t outside(std::string_view clause) {
    add("outside", 1, clause);
    return std::nullopt;
  }

  // The ray at `a`, `b`: trace() of ray.hpp, number by number.
  std::optional<Ray> add_ray(std::string_view stage, int32_t a, int32_t b) {
    begin(stage);
    add("a", a, "RAY-1");
    add("b", b, "RAY-1");
    const IntVector n = direction(record_, a, b);
    add("n.x", n.x, "RAY-1");
    add("n.y", n.y, "RAY-1");
    add("n.z", n.z, "RAY-1");
    const auto slope = slopes(n);
    if (!slope) return outside("RAY-2");
    add("w", reciprocal(n.z), "RAY-2");
    add("sx", slope->x, "RAY-2");
    add("sy", slope->y, "RAY-2");
    const int32_t u = record_.u0 - shift_along(record_.zu, slope->x);
    const int32_t v = record_.v0 - shift_along(record_.zv, slope->y);
    add("U", u, "RAY-3");
    add("V", v, "RAY-3");
    if (!place_among_views(u, record_.cols) || !place_among_views(v, record_.rows)) {
      return outside("RAY-3");
    }
    add("xb", record_.x0 + shift_along(record_.gain, slope->x), "RAY-4");
    add("yb", record_.y0 + shift_along(record_.gain, slope->y), "RAY-4");
    const auto ray = hmlfc::trace(record_, n);
    if (!ray) return outside("RAY-5");
    add("nearest view's row", hmlfc::nearest_view(ray->v), "RAY-5");
    add("nearest view's column", hmlfc::nearest_view(ray->u), "RAY-5");
    return ray;
  }

  // E of a cell (SRF-3).
  int32_t displacement(int32_t ci, int32_t cj) {
    const auto ray = add_ray("cell ray", ray_of_cell(ci, record_.frame_width),
                             ray_of_cell(cj, record_.frame_height));
    if (!ray) return 0;
    Proposals proposals;
    for_each_view_taps(record_, *ray, 0, [&](const ViewTaps& taps) {
      proposals.add(add_proposal(*ray, taps), static_cast<int32_t>(taps.weight));
    });
    begin("cell");
    add("ci", ci, "SRF-1");
    add("cj", cj, "SRF-1");
    add("median", proposals.median(), "SRF-3");
    add("E", proposals.chosen(), "SRF-3");
    return proposals.chosen();
  }

  int32_t add_proposal(const Ray& ray, const ViewTaps& taps) {
    begin("proposal", taps.view);
    add("weight", taps.weight, "SMP-1");
    int32_t e = 0;
    for (int step = 0; step < kDisplacementSteps; ++step) {
      const auto [x, y] = place(ray, e, taps.view);
      const auto bx = static_cast<uint32_t>(nearest_pixel(x, record_.width));
      const auto by = static_cast<uint32_t>(nearest_pixel(y, record_.height));
      add("x(c, E)", x, "SRF-2");
      add("y(r, E)", y, "SRF-2");
      const unsigned log2 = decoder_.header().block_log2;
      const auto told = block_disparity(decoder_, taps.view, bx >> log2, by >> log2);
      const BlockDisparity disparity = told ? *told : BlockDisparity{};
      add("D", disparity.disparity, "GEO-2");
      add("confidence", disparity.confidence, "GEO-6");
      e = displacement_of(disparity, record_);
      add("E", e, "SRF-3");
    }
    return e;
  }

  // x(c, E) and y(r, E).
  std::pair<int32_t, int32_t> place(const Ray& ray, int32_t e, ViewPos view) const {
    const int32_t g = displacement_a_row(e, record_.pitch);
    return {x_in_view(record_, ray, e, static_cast<int32_t>(view.col)),
            y_in_view(record_, ray, g, static_cast<int32_t>(view.row))};
  }

  // The part of a view; returns its q.
  Rgb add_view(const Ray& ray, int32_t e, const ViewTaps& taps) {
    begin("view", taps.view);
    const auto [x, y] = place(ray, e, taps.view);
    add("weight", taps.weight, "SMP-1");
    add("x", x, e == 0 ? "RAY-4" : "SRF-2");
    add("y", y, e == 0 ? "RAY-4" : "SRF-2");
    add("xi", taps.x.first, "SMP-2");
    add("fx", taps.x.fraction, "SMP-2");
    add("yi", taps.y.first, "SMP-2");
    add("fy", taps.y.fraction, "SMP-2");
    for (int32_t row = taps.y.first; row <= taps.y.last(); ++row) {
      for (int32_t col = taps.x.first; col <= taps.x.last(); ++col) {
        add_colour({"pixel R", "pixel G", "pixel B"}, blocks_.pixel(taps.view, col, row), "COL-2");
      }
    }
    const Rgb q = blocks_.colour(taps);
    add_colour({"q R", "q G", "q B"}, q, "SMP-2");
    return q;
  }

  void add_colour(const std::array<std::string_view, 3>& names, const Rgb& colour,
                  std::string_view clause) {
    add(names[0], colour.r, clause);
    add(names[1], colour.g, clause);
    add(names[2], colour.b, clause);
  }

  void add_sums(const std::array<uint32_t, 3>& sums) {
    constexpr std::array<std::string_view, 3> kSums{"sum R", "sum G", "sum B"};
    constexpr std::array<std::string_view, 3> kSamples{"R", "G", "B"};
    begin("sum");
    for (size_t k = 0; k < 3; ++k) add(kSums[k], sums[k], "SMP-3");
    for (size_t k = 0; k < 3; ++k) {
      found_.sample[k] = frame_sample(sums[k], decoder_.header().depth);
      add(kSamples[k], found_.sample[k], "SMP-3");
    }
  }

  const Decoder& decoder_;
  const FrameRecord& record_;
  int stop_level_;
  GoldenBlocks blocks_;
  FrameTrace found_;
};

}  // namespace

std::array<std::string_view, sizeof(FrameRecord) / 4> frame_record_names() {
  return {"frame_width", "frame_height", "filter",   "aperture", "n0_hi.x", "n0_hi.y", "n0_hi.z",
          "n0_lo.x",     "n0_lo.y",      "n0_lo.z",  "na_hi.x",  "na_hi.y", "na_hi.z", "na_lo.x",
          "na_lo.y",     "na_lo.z",      "nb_hi.x",  "nb_hi.y",  "nb_hi.z", "nb_lo.x", "nb_lo.y",
          "nb_lo.z",     "u0",           "v0",       "zu",       "zv",      "x0",      "y0",
          "gain",        "dx",           "dy",       "c0",       "r0",      "cols",    "rows",
          "width",       "height",       "geometry", "focus",    "pitch",   "fine"};
}

Integers frame_record_values(const FrameRecord& record) { return std::bit_cast<Integers>(record); }

Result<FrameTrace> frame_trace(const Decoder& decoder, const FrameRecord& record, int stop_level,
                               uint32_t x, uint32_t y) {
  if (!fits(record, decoder.header(), stop_level) ||
      x >= static_cast<uint32_t>(record.frame_width) ||
      y >= static_cast<uint32_t>(record.frame_height)) {
    return fail(ErrorCode::kBadRequest, Section::kHeader, 0);
  }
  return guard_request(DecoderAccess::stream(decoder).source, [&] {
    return FrameTracer(decoder, record, stop_level)
        .trace(static_cast<int32_t>(x), static_cast<int32_t>(y));
  });
}

}  // namespace hmlfc
