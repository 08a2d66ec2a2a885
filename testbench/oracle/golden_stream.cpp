#include "oracle/golden_stream.hpp"

#include "syntax/header.hpp"
#include "syntax/index.hpp"

namespace hmlfc::tb {

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
