#include "io/disparity_range.hpp"

#include <algorithm>
#include <mutex>

#include <fmt/format.h>

#include "io/parallel.hpp"

namespace hmlfc::io {

void DisparityRange::add(const DisparityRange& other) {
  blocks += other.blocks;
  if (other.known == 0) return;
  least = known == 0 ? other.least : std::min(least, other.least);
  greatest = known == 0 ? other.greatest : std::max(greatest, other.greatest);
  known += other.known;
}

void DisparityRange::add(const DisparityMap& map) {
  for (const BlockDisparity& block : map.blocks) {
    const int32_t d = block.disparity;
    add(DisparityRange{d, d, block.confidence > 0 ? 1u : 0u, 1});
  }
}

Result<std::optional<DisparityRange>> disparity_range(const Decoder& decoder, uint64_t bytes) {
  constexpr uint64_t kViewCost = 64;  // of a view, in blocks
  constexpr uint64_t kFew = uint64_t{1} << 25;
  constexpr uint64_t kBlocksAByte = 256;  // the smallest streams of real views have 50
  const StreamHeader& header = decoder.header();
  const uint64_t side = header.block_size();
  const uint64_t blocks = ((header.width + side - 1) / side) * ((header.height + side - 1) / side);
  const uint64_t views = uint64_t{header.rows} * header.cols;
  if (views * (blocks + kViewCost) > kFew + kBlocksAByte * bytes) return std::nullopt;
  DisparityRange range;
  FirstError<Error> first;
  std::mutex mutex;
  for_each_index(views, 0, {}, [&](size_t index) {
    if (first.makes_pointless(index)) return;
    const auto row = static_cast<uint32_t>(index / header.cols);
    const auto map = disparity_map(decoder, {row, static_cast<uint32_t>(index % header.cols)});
    if (!map) return first.add(index, map.error());
    DisparityRange own;
    own.add(*map);
    const std::scoped_lock lock(mutex);
    range.add(own);
  });
  if (first.error()) return tl::unexpected(*first.error());
  return range;
}

std::string describe(const std::optional<DisparityRange>& counted) {
  if (!counted) return "disparity not counted: too many blocks for so few bytes";
  const DisparityRange& range = *counted;
  if (range.known == 0) return "disparity unknown";
  return fmt::format("disparity {:.2f} to {:.2f} pixels a column, known for {:.1f} % of the blocks",
                     static_cast<double>(range.least) / kDisparityUnits,
                     static_cast<double>(range.greatest) / kDisparityUnits,
                     100 * static_cast<double>(range.known) / static_cast<double>(range.blocks));
}

}  // namespace hmlfc::io
