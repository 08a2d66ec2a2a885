#include "decoder/open_stream.hpp"

#include <algorithm>

#include "bits/crc32c.hpp"
#include "bits/little_endian.hpp"
#include "decoder/key_images.hpp"
#include "syntax/header.hpp"
#include "syntax/index.hpp"

namespace hmlfc {
namespace {

// Loads the header of a partial source, as long as the file says that it is.
bool is_header_loaded(ByteSource& source) {
  const auto file = source.bytes();
  const uint64_t fixed = std::min<uint64_t>(file.size(), kAtHeaderBytes + 2);
  if (!is_loaded(source, {0, fixed})) return false;
  if (fixed < kAtHeaderBytes + 2) return true;
  const uint64_t all = load_le<uint16_t>(file, kAtHeaderBytes);
  return is_loaded(source, {0, std::min<uint64_t>(file.size(), all)});
}

Result<void> check_section_crcs(const StreamView& stream) {
  for (const SectionEntry* entry : section_entries(stream.header)) {
    const auto section = static_cast<Section>(entry->type);
    const auto bytes = stream.read(section, 0, entry->size);
    if (!bytes) return tl::unexpected(bytes.error());
    if (crc32c(*bytes) != entry->crc) {
      return stream.error(ErrorCode::kBadSectionCrc, section, 0);
    }
  }
  return {};
}

}  // namespace

Result<StreamView> open_stream(ByteSource& source, const OpenOptions& options) {
  const auto file = source.bytes();
  if (source.is_partial() && !is_header_loaded(source)) {
    return fail(ErrorCode::kBusError, Section::kHeader, 0);
  }
  auto header = parse_header(file);
  if (!header) return tl::unexpected(header.error());
  const uint64_t samples = uint64_t{header->width} * header->height;
  if (samples > options.limits.max_plane_samples) {
    return fail(ErrorCode::kLimitExceeded, Section::kHeader, 20);
  }
  StreamView stream{file,
                    *header,
                    Geometry(*header),
                    nullptr,  // what is read to open the stream is not reported
                    source.is_partial() ? &source : nullptr,
                    options.limits.max_code_blocks};
  if (auto ok = check_index_sizes(stream); !ok) return tl::unexpected(ok.error());
  if (auto ok = check_top_table(stream); !ok) return tl::unexpected(ok.error());
  if (options.check_sections) {
    if (auto ok = check_section_crcs(stream); !ok) return tl::unexpected(ok.error());
  }
  stream.reads = options.reads;
  return stream;
}

}  // namespace hmlfc
