#include "render/find_focus.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <tuple>

#include "decoder/missing_ranges.hpp"
#include "decoder/open_stream.hpp"
#include "decoder/request_guard.hpp"
#include "render/block_disparity.hpp"
#include "render/ray.hpp"
#include "render/taps.hpp"

namespace hmlfc {
namespace {

constexpr int kMaxSteps = 8;  // of a ray in one view

// Where a ray meets the view plane, in 2^-16 steps, and the picture of a view, in 2^-12 pixels.
struct Meeting {
  int32_t u = 0;
  int32_t v = 0;
  int32_t x = 0;
  int32_t y = 0;
};

// The ray of one pixel of a frame, which may be followed to any disparity.
class PixelRay {
 public:
  PixelRay(const StreamView& stream, const Camera& camera, uint32_t x, uint32_t y)
      : stream_(stream),
        camera_(camera),
        i_(static_cast<int32_t>(x)),
        j_(static_cast<int32_t>(y)) {}

  // The frame record with the focal plane at `disparity`; nothing where there is none.
  std::optional<FrameRecord> record(int disparity) const {
    Camera camera = camera_;
    camera.focus = static_cast<double>(disparity) / kDisparityUnits;
    const auto made = frame_record(camera, stream_.header);
    return made ? std::optional(*made) : std::nullopt;
  }

  // Where the ray is in `view` at the disparity in focus; nothing where it misses the
  // grid (RAY-2, RAY-3).
  std::optional<Meeting> meet(const FrameRecord& f, ViewPos view) const {
    const auto row = static_cast<int32_t>(view.row);
    const auto col = static_cast<int32_t>(view.col);
    const auto slope =
        slopes(direction(f, 2 * i_ + 1 - f.frame_width, 2 * j_ + 1 - f.frame_height));
    if (!slope) return std::nullopt;
    const auto u = place_among_views(f.u0 - shift_along(f.zu, slope->x), f.cols);
    const auto v = place_among_views(f.v0 - shift_along(f.zv, slope->y), f.rows);
    if (!u || !v) return std::nullopt;
    return Meeting{u->inside, v->inside, x_in_view(f, f.x0 + shift_along(f.gain, slope->x), col),
                   y_in_view(f, f.y0 + shift_along(f.gain, slope->y), row)};
  }

  // Whether the pixel is inside in the frame that is focused at `disparity` (RAY-5).
  bool is_inside(int disparity) const {
    const auto f = record(disparity);
    return f && trace(*f, i_, j_);
  }

  // The disparity of what the ray hits as `view` sees it; nothing where the view does not know.
  Result<std::optional<int16_t>> follow(ViewPos view) const {
    int16_t before = 0;
    int16_t disparity = 0;
    for (int step = 0; step < kMaxSteps; ++step) {
      const auto f = record(disparity);
      const auto at = f ? meet(*f, view) : std::nullopt;
      if (!at) return std::nullopt;
      const auto told = told_around(view, at->x, at->y);
      if (!told || !*told || **told == disparity) return told;
      before = disparity;
      disparity = **told;
    }
    return std::max(before, disparity);
  }

 private:
  // The median around picture position (x, y) of a view, which is clamped into the picture.
  Result<std::optional<int16_t>> told_around(ViewPos view, int32_t x, int32_t y) const {
    const StreamHeader& header = stream_.header;
    const auto block = [&](int32_t at, uint32_t size) {
      return static_cast<uint32_t>(nearest_pixel(at, static_cast<int32_t>(size))) >>
             header.block_log2;
    };
    const uint32_t bx = block(x, header.width);
    const uint32_t by = block(y, header.height);
    const uint32_t last_x = (header.width - 1) >> header.block_log2;
    const uint32_t last_y = (header.height - 1) >> header.block_log2;
    std::array<int16_t, 9> told{};
    size_t count = 0;
    for (uint32_t row = by - std::min(by, 1u); row <= std::min(by + 1, last_y); ++row) {
      for (uint32_t col = bx - std::min(bx, 1u); col <= std::min(bx + 1, last_x); ++col) {
        const auto found = walk_to_block_disparity(stream_, view, col, row, nullptr);
        if (!found) return tl::unexpected(found.error());
        if (found->confidence > 0) told[count++] = found->disparity;
      }
    }
    if (count == 0) return std::nullopt;
    std::sort(told.begin(), told.begin() + static_cast<ptrdiff_t>(count));
    return told[(count - 1) / 2];
  }

  const StreamView& stream_;
  const Camera& camera_;
  int32_t i_;
  int32_t j_;
};

// A view that may tell, and how far it is from the ray: squared, in 2^-32 steps; -1 for the nearest
// view of RAY-5.
struct Candidate {
  int64_t distance = 0;
  ViewPos view;
};

// Finds the view nearest to the ray and those next to it, the nearest first, among equals row by
// row. Returns how many.
size_t views_near(const FrameRecord& f, const Meeting& at, std::array<Candidate, 9>& views) {
  const int32_t row = nearest_view(at.v);
  const int32_t col = nearest_view(at.u);
  size_t count = 0;
  for (int32_t r = std::max(row - 1, 0); r <= std::min(row + 1, f.rows - 1); ++r) {
    for (int32_t c = std::max(col - 1, 0); c <= std::min(col + 1, f.cols - 1); ++c) {
      const int64_t across = (int64_t{c} << 16) - at.u;
      const int64_t along = (int64_t{r} << 16) - at.v;
      const bool is_nearest = r == row && c == col;
      views[count++] = {is_nearest ? -1 : across * across + along * along,
                        {static_cast<uint32_t>(r), static_cast<uint32_t>(c)}};
    }
  }
  const auto key = [](const Candidate& c) {
    return std::tuple(c.distance, c.view.row, c.view.col);
  };
  std::ranges::sort(views.begin(), views.begin() + static_cast<ptrdiff_t>(count), {}, key);
  return count;
}

}  // namespace

Result<FocusPoint> find_focus(const StreamView& stream, const Camera& camera, uint32_t x,
                              uint32_t y) {
  const PixelRay ray(stream, camera, x, y);
  const auto flat = ray.record(0);
  if (!flat || x >= static_cast<uint32_t>(flat->frame_width) ||
      y >= static_cast<uint32_t>(flat->frame_height)) {
    return fail(ErrorCode::kBadRequest, Section::kHeader, 0);
  }
  const auto at = ray.meet(*flat, {});
  if (!at) return FocusPoint{PixelSight::kOutside, 0, {}};
  const bool is_seen = ray.is_inside(0);
  std::array<Candidate, 9> views;
  const size_t count = views_near(*flat, *at, views);
  for (size_t k = 0; k < count; ++k) {
    const auto found = ray.follow(views[k].view);
    if (!found) return tl::unexpected(found.error());
    if (!*found) continue;
    if (!is_seen && !ray.is_inside(**found)) break;
    return FocusPoint{PixelSight::kSurface, **found, views[k].view};
  }
  return FocusPoint{is_seen ? PixelSight::kUnknown : PixelSight::kOutside, 0, {}};
}

Result<FocusPoint> focus_at(const Decoder& decoder, const Camera& camera, uint32_t x, uint32_t y) {
  const StreamView& stream = DecoderAccess::stream(decoder);
  return guard_request(stream.source, [&] {
    if (stream.source != nullptr) {
      load_by_trials(stream, [&](const StreamView& view, const MissingRanges&) {
        static_cast<void>(find_focus(view, camera, x, y));
      });
    }
    return find_focus(stream, camera, x, y);
  });
}

}  // namespace hmlfc
