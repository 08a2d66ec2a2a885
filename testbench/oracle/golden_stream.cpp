#include "oracle/golden_stream.hpp"

#include "decoder/golden/block_walk.hpp"
#include "syntax/header.hpp"
#include "syntax/index.hpp"

namespace hmlfc::tb {
namespace {

constexpr size_t kShardBlocks = 4096;  // of B * B values each

uint64_t key_of(const BlockSite& site) {
  const uint64_t image = uint64_t{site.image_row} << 12 | site.image_col;
  const uint64_t block = uint64_t{site.by} << 15 | site.bx;
  return (image << 6 | static_cast<uint64_t>(site.level) << 2 | static_cast<uint64_t>(site.plane))
             << 30 |
         block;
}

}  // namespace

Result<BlockValues> GoldenReferences::block(const BlockSite& site) const {
  const uint64_t key = key_of(site);
  Shard& shard = shards_[(key * 0x9e3779b97f4a7c15u) >> 60];
  {
    const std::lock_guard lock(shard.mutex);
    if (const auto kept = shard.blocks.find(key); kept != shard.blocks.end()) return kept->second;
  }
  const auto coded = walk_to_block(stream_, Probe{nullptr, nullptr, site});
  Result<BlockValues> values =
      coded ? Result<BlockValues>(coded->residual) : tl::unexpected(coded.error());
  const std::lock_guard lock(shard.mutex);
  if (shard.blocks.size() == kShardBlocks) shard.blocks.clear();
  shard.blocks.emplace(key, values);
  return values;
}

bool exceeds_limits(const StreamHeader& header, const UnitParameters& unit) {
  return header.block_log2 != unit.block_log2 || header.depth > static_cast<int>(unit.max_depth) ||
         header.width > kMaxUnitSide || header.height > kMaxUnitSide ||
         header.rows > kMaxUnitGrid || header.cols > kMaxUnitGrid ||
         header.tree_height > kMaxUnitHeight;
}

Result<std::unique_ptr<GoldenStream>> GoldenStream::open(std::span<const uint8_t> file,
                                                         const UnitParameters& unit) {
  auto header = parse_header(file);
  if (!header) return tl::unexpected(header.error());
  if (exceeds_limits(*header, unit)) return fail(ErrorCode::kLimitExceeded, Section::kHeader, 0);
  StreamView view{file, *header, Geometry(*header)};
  if (auto ok = check_index_sizes(view); !ok) return tl::unexpected(ok.error());
  if (auto ok = check_top_table(view); !ok) return tl::unexpected(ok.error());
  return std::unique_ptr<GoldenStream>(new GoldenStream(std::move(view)));
}

}  // namespace hmlfc::tb
