// The record of a motion tile: its palette and the entry of every motion block (MOT-3, MOT-4).
#include <algorithm>
#include <iterator>

#include "syntax/index.hpp"
#include "syntax/motion_tile.hpp"
#include "target.hpp"
#include "tile_places.hpp"

namespace hmlfc::fuzz {
namespace {

MotionContext read_context(InputReader& input) {
  MotionContext context;
  context.tile_log2 = input.within(5, 7);
  const uint32_t side = 1u << context.tile_log2;
  context.width = input.within(0, 127) % side + 1;
  context.height = input.within(0, 127) % side + 1;
  context.block_size = 2u << input.within(0, 2);
  context.two_references = input.flag();
  context.disparities = input.flag();
  context.keyed = input.flag();
  return context;
}

void put_context(const MotionContext& context, Bytes& bytes) {
  const unsigned block = context.block_size / 4;  // 0, 1, 2
  for (const unsigned value :
       {context.tile_log2 - 5, context.width - 1, context.height - 1, block,
        unsigned{context.two_references}, unsigned{context.disparities}, unsigned{context.keyed}}) {
    bytes.push_back(static_cast<uint8_t>(value));
  }
}

}  // namespace

void run(std::span<const uint8_t> input) {
  InputReader reader(input);
  const MotionContext context = read_context(reader);
  const BitString record(reader.rest());
  FieldCursor cursor(record, 0, Probe{});
  const auto head = read_motion_head(cursor, context);
  if (!head) return;
  const uint32_t side = 1u << head->block_log2;
  for (uint32_t y = 0; y < context.height; y += side) {
    for (uint32_t x = 0; x < context.width; x += side) {
      const auto entry = read_motion_entry(cursor, *head, context, x, y);
      if (entry) demand(is_usable(*entry, context), "a block uses an entry that it must not");
    }
  }
}

std::vector<Bytes> seeds(std::span<const uint8_t> file) {
  std::vector<Bytes> found;
  const auto stream = open_view(file);
  if (!stream) return found;
  for_each_motion_tile(*stream, false, [&](const MotionTilePlace& place) {
    if (found.size() >= kMaxRecords) return;
    const auto record = find_motion_record(*stream, place, Probe{});
    if (!record || !*record) return;
    Bytes bytes;
    put_context(motion_context(*stream, place), bytes);
    const auto tile = (*record)->bits.bytes();
    std::ranges::copy(tile, std::back_inserter(bytes));
    found.push_back(std::move(bytes));
  });
  return found;
}

}  // namespace hmlfc::fuzz
