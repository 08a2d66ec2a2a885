#include "cli/disparity_range.hpp"

#include <algorithm>
#include <mutex>

#include <fmt/format.h>

#include "cli/for_each_view.hpp"

namespace hmlfc::cli {

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

DisparityRange disparity_range(const StreamFile& file) {
  DisparityRange range;
  std::mutex mutex;
  for_each_view({file.header().rows, file.header().cols}, 0, {}, [&](ViewPos view) {
    DisparityRange own;
    own.add(file.value(disparity_map(file.decoder(), view)));
    const std::scoped_lock lock(mutex);
    range.add(own);
  });
  return range;
}

std::string describe(const DisparityRange& range) {
  if (range.known == 0) return "disparity unknown";
  return fmt::format("disparity {:.2f} to {:.2f} pixels a column, known for {:.1f} % of the blocks",
                     static_cast<double>(range.least) / kDisparityUnits,
                     static_cast<double>(range.greatest) / kDisparityUnits,
                     100 * static_cast<double>(range.known) / static_cast<double>(range.blocks));
}

}  // namespace hmlfc::cli
