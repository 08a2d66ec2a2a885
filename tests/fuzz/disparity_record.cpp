// The disparities of a reference image's motion tile (MOT-6).
#include "syntax/index.hpp"
#include "syntax/motion_tile.hpp"

#include "arithmetic/motion.hpp"
#include "target.hpp"
#include "tile_places.hpp"

namespace hmlfc::fuzz {

void run(std::span<const uint8_t> input) {
  InputReader reader(input);
  DisparityContext context;
  context.columns = reader.within(1, 32);
  context.rows = reader.within(1, 32);
  const BitString record(reader.rest());
  FieldCursor cursor(record, 0, Probe{});
  const auto head = read_disparity_head(cursor, context);
  if (!head) return;
  for (uint32_t gy = 0; gy < context.rows; ++gy) {
    for (uint32_t gx = 0; gx < context.columns; ++gx) {
      const auto disparity = read_disparity(cursor, *head, context, gx, gy);
      if (disparity) {
        demand(*disparity >= head->min_disparity && *disparity <= kMaxDisparity,
               "a disparity outside its interval");
      }
    }
  }
}

std::vector<Bytes> seeds(std::span<const uint8_t> file) {
  std::vector<Bytes> found;
  const auto stream = open_view(file);
  if (!stream || !stream->header.has(Feature::kSharedDisparity)) return found;
  for_each_motion_tile(*stream, true, [&](const MotionTilePlace& place) {
    if (found.size() >= kMaxRecords) return;
    const auto record = find_motion_record(*stream, place, Probe{});
    if (!record || !*record) return;
    const DisparityContext context = disparity_context(*stream, place);
    Bytes bytes{static_cast<uint8_t>(context.columns - 1), static_cast<uint8_t>(context.rows - 1)};
    const auto tile = (*record)->bits.bytes();
    bytes.insert(bytes.end(), tile.begin(), tile.end());
    found.push_back(std::move(bytes));
  });
  return found;
}

}  // namespace hmlfc::fuzz
