#include "decoder/golden/block_walk.hpp"

#include "arithmetic/bise.hpp"
#include "arithmetic/reconstruct.hpp"
#include "syntax/tile_record.hpp"

namespace hmlfc {
namespace {

// The residual of TIL-10 and STP-3 from the block's BISE values (TIL-9).
void read_residual(const FieldCursor& cursor, const BlockEntry& entry, const SampleRange& range,
                   BlockValues& residual) {
  const uint64_t count = residual.size();
  const auto bits = static_cast<unsigned>(bise_bits(entry.levels, 1));
  for (size_t i = 0; i < count; ++i) {
    const uint32_t value = bise_value(cursor.record(), entry.values_at, entry.levels, count, i);
    cursor.probe().field(Section::kTile, cursor.file_bit(entry.values_at), bits, "value", "TIL-9",
                         value);
    residual[i] = stepped_residual(value, entry.levels.count, entry.bias, entry.step, range);
  }
}

}  // namespace

Result<CodedBlock> walk_to_block(const StreamView& stream, const Probe& probe) {
  const BlockSite& site = probe.site;
  CodedBlock block{{}, BlockValues(stream.geometry.block_size())};
  probe.walk();
  const auto record = find_record(stream, site, probe);
  if (!record) return tl::unexpected(record.error());
  if (!*record) return block;

  FieldCursor cursor((*record)->bits, (*record)->file_bit, probe);
  const TileContext context = tile_context(stream, site);
  const auto head = read_tile_head(cursor, context);
  if (!head) return tl::unexpected(head.error());
  const unsigned k = block_number(site.bx % kTileBlocks, site.by % kTileBlocks);
  const auto entry = read_block_entry(cursor, *head, context, k);
  if (!entry) return tl::unexpected(entry.error());
  block.entry = *entry;
  if (entry->has_residual()) {
    read_residual(cursor, *entry, sample_range(site.plane, stream.header.depth), block.residual);
  }
  return block;
}

}  // namespace hmlfc
