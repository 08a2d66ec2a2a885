// The record of a tile: its head, and header and values of each block (TIL-1 to TIL-10).
#include <algorithm>
#include <array>
#include <bit>
#include <iterator>

#include "arithmetic/bise.hpp"
#include "arithmetic/reconstruct.hpp"
#include "arithmetic/widths.hpp"
#include "decoder/fast/bise_unpack.hpp"
#include "syntax/index.hpp"
#include "syntax/tile_record.hpp"
#include "target.hpp"
#include "tile_places.hpp"

namespace hmlfc::fuzz {
namespace {

TileContext read_context(InputReader& input) {
  PlaneShape plane;
  plane.blocks_x = input.within(1, 8);
  plane.blocks_y = input.within(1, 8);
  TileContext context;
  context.blocks_inside = blocks_inside(plane, 0, 0);
  context.predictive = input.flag();
  context.window = static_cast<int>(input.within(0, 127));
  context.depth = static_cast<int>(input.within(8, 12));
  context.block_samples = uint64_t{4} << (2 * input.within(0, 2));
  context.steps = input.flag();
  return context;
}

void put_context(const TileContext& context, Bytes& bytes) {
  unsigned columns = 0;
  unsigned rows = 0;
  for (unsigned k = 0; k < 64; ++k) {
    if (((context.blocks_inside >> k) & 1) == 0) continue;
    columns = std::max(columns, block_column(k) + 1);
    rows = std::max(rows, block_row(k) + 1);
  }
  const auto log2 = static_cast<unsigned>(std::bit_width(context.block_samples)) / 2;
  for (const unsigned value :
       {columns - 1, rows - 1, unsigned{context.predictive}, unsigned(context.window),
        unsigned(context.depth - 8), log2 - 1, unsigned{context.steps}}) {
    bytes.push_back(static_cast<uint8_t>(value));
  }
}

// Compares the two readers of the values of a block.
void check_values(const BlockEntry& entry, const TileContext& context, const PaddedRecord& record) {
  std::array<uint16_t, 64> values;
  bise_unpack(record.data(), entry.values_at, entry.levels, context.block_samples, values.data());
  const SampleRange range = sample_range(Plane::kCo, context.depth);
  for (uint64_t i = 0; i < context.block_samples; ++i) {
    const uint32_t value =
        bise_value(record.bits(), entry.values_at, entry.levels, context.block_samples, i);
    demand(value == values[i], "bise_value and bise_unpack differ");
    const int32_t residual =
        stepped_residual(value, entry.levels.count, entry.bias, entry.step, range);
    demand(residual >= -range.bound && residual <= range.bound,
           "a residual outside its interval (TIL-10)");
  }
}

}  // namespace

void run(std::span<const uint8_t> input) {
  InputReader reader(input);
  const TileContext context = read_context(reader);
  const PaddedRecord record(reader.rest());
  FieldCursor cursor(record.bits(), 0, Probe{});
  const auto head = read_tile_head(cursor, context);
  if (!head) return;
  for (unsigned k = 0; k < 64; ++k) {
    FieldCursor at = cursor;
    const auto entry = read_block_entry(at, *head, context, k);
    if (!entry) continue;
    demand(std::abs(entry->dx) <= context.window && std::abs(entry->dy) <= context.window,
           "a vector outside the window (TIL-7)");
    if (entry->has_residual()) check_values(*entry, context, record);
  }
}

std::vector<Bytes> seeds(std::span<const uint8_t> file) {
  std::vector<Bytes> found;
  const auto stream = open_view(file);
  if (!stream) return found;
  for_each_tile(*stream, [&](const BlockSite& site) {
    if (found.size() >= kMaxRecords) return;
    const auto record = find_record(*stream, site, Probe{});
    if (!record || !*record) return;
    Bytes bytes;
    put_context(tile_context(*stream, site), bytes);
    const auto tile = (*record)->bits.bytes();
    std::ranges::copy(tile, std::back_inserter(bytes));
    found.push_back(std::move(bytes));
  });
  return found;
}

}  // namespace hmlfc::fuzz
