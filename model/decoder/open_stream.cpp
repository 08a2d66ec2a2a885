#include "decoder/open_stream.hpp"

#include "bits/crc32c.hpp"
#include "decoder/key_images.hpp"
#include "syntax/header.hpp"
#include "syntax/index.hpp"

namespace hmlfc {
namespace {

Result<void> check_section_crcs(const StreamView& stream) {
  for (const SectionEntry* entry : section_entries(stream.header)) {
    const auto section = static_cast<Section>(entry->type);
    if (crc32c(stream.bytes(section)) != entry->crc) {
      return stream.error(ErrorCode::kBadSectionCrc, section, 0);
    }
  }
  return {};
}

}  // namespace

Result<StreamView> open_stream(std::span<const uint8_t> file, const OpenOptions& options) {
  auto header = parse_header(file);
  if (!header) return tl::unexpected(header.error());
  const uint64_t samples = uint64_t{header->width} * header->height;
  if (samples > options.limits.max_plane_samples) {
    return fail(ErrorCode::kLimitExceeded, Section::kHeader, 20);
  }
  StreamView stream{file, *header, Geometry(*header), options.reads};
  if (auto ok = check_index_sizes(stream); !ok) return tl::unexpected(ok.error());
  if (auto ok = check_top_table(stream); !ok) return tl::unexpected(ok.error());
  if (options.check_sections) {
    if (auto ok = check_section_crcs(stream); !ok) return tl::unexpected(ok.error());
  }
  return stream;
}

}  // namespace hmlfc
