#include "request_check.hpp"

namespace hmlfc::vectors {
namespace {

template <class Answer>
void demand_refused(const Answer& answer, const char* what) {
  demand(!answer && answer.error().code == ErrorCode::kBadRequest && answer.error().offset == 0,
         what);
}

void check_blocks(const Decoder& decoder) {
  const StreamHeader& header = decoder.header();
  const PlaneSize size = decoder.plane_size(Plane::kY);
  const auto check = [&](const BlockAddress& block, int level) {
    demand_refused(decoder.decode_block(block, {.stop_level = level}),
                   "a block that is not there decodes");
  };
  check({{header.rows, 0}, Plane::kY, 0, 0}, 0);
  check({{0, header.cols}, Plane::kY, 0, 0}, 0);
  check({{}, Plane::kY, size.width, 0}, 0);
  check({{}, Plane::kY, 0, size.height}, 0);
  check({}, header.tree_height + 1);
  check({}, -1);
}

// A part of a view that is not there, or at a level that is not.
void check_missing_part(const Decoder& decoder, ViewPos view, const Rect& rect, int level) {
  std::vector<int16_t> samples(size_t{rect.width} * rect.height);
  const char* what = "a part that is not there decodes";
  demand_refused(decoder.decode_rect(view, Plane::kY, rect, level), what);
  demand_refused(decoder.decode_rgb(view, rect, level), what);
  demand_refused(decoder.refine_rect(view, Plane::kY, rect, level, samples), what);
}

void check_parts(const Decoder& decoder, const Rect& whole) {
  const StreamHeader& header = decoder.header();
  for (const Rect& rect :
       {Rect{0, 0, 0, 1}, Rect{0, 0, 1, 0}, Rect{whole.width, 0, 1, 1}, Rect{0, whole.height, 1, 1},
        Rect{0, 0, whole.width + 1, 1}, Rect{0, 0, 1, whole.height + 1}}) {
    check_missing_part(decoder, {}, rect, 0);
  }
  check_missing_part(decoder, {header.rows, 0}, whole, 0);
  check_missing_part(decoder, {0, header.cols}, whole, 0);
  for (const int level : {-1, header.tree_height + 1}) {
    check_missing_part(decoder, {}, whole, level);
    demand_refused(decoder.decode_all([](ViewPos, RgbImage&&) {}, {level, 1}),
                   "a level that is not there decodes");
  }
}

// A refinement takes whole blocks, as many samples as they have, and a level above it.
void check_refinements(const Decoder& decoder, const Rect& whole) {
  const auto check = [&](const Rect& rect, size_t samples) {
    std::vector<int16_t> above(samples);
    demand_refused(decoder.refine_rect({}, Plane::kY, rect, 0, above), "half a block is refined");
  };
  const size_t count = size_t{whole.width} * whole.height;
  check(whole, count + 1);
  std::vector<int16_t> top(count);
  demand_refused(decoder.refine_rect({}, Plane::kY, whole, decoder.header().tree_height, top),
                 "the top level is put on another");
  if (whole.width < 2 || whole.height < 2) return;
  check({1, 0, whole.width - 1, whole.height}, count - whole.height);
  check({0, 1, whole.width, whole.height - 1}, count - whole.width);
  check({0, 0, 1, whole.height}, whole.height);
  check({0, 0, whole.width, 1}, whole.width);
}

// What begins with the second row and column of a view, and within a plane's blocks, is that part.
void check_inner_parts(const Decoder& decoder, const Rect& whole) {
  for (const Plane plane : kPlanes) {
    const auto [width, height] = decoder.plane_size(plane);
    const Rect inner{width / 3, height / 3, (width + 1) / 2, (height + 1) / 2};
    const auto samples = decoder.decode_plane({}, plane);
    const auto part = decoder.decode_rect({}, plane, inner);
    demand(!samples || (part && *part == part_of(*samples, width, inner)),
           "a part of a plane differs");
  }
  const auto view = decoder.decode_view({});
  if (!view || whole.width < 2 || whole.height < 2) return;
  const Rect inner{1, 1, whole.width - 1, whole.height - 1};
  const auto part = decoder.decode_rgb({}, inner);
  const Rect values{3, 1, inner.width * 3, inner.height};
  demand(part && part->samples == part_of(view->samples, size_t{whole.width} * 3, values),
         "a part of a view differs");
}

}  // namespace

void check_requests(const Decoder& decoder) {
  const PlaneSize size = decoder.plane_size(Plane::kY);
  const Rect whole{0, 0, size.width, size.height};
  check_blocks(decoder);
  check_parts(decoder, whole);
  check_refinements(decoder, whole);
  check_inner_parts(decoder, whole);
}

}  // namespace hmlfc::vectors
