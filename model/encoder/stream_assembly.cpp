#include "encoder/stream_assembly.hpp"

#include "bits/crc32c.hpp"
#include "bits/little_endian.hpp"
#include "decoder/key_images.hpp"
#include "syntax/header.hpp"

namespace hmlfc {

std::vector<uint8_t> top_section(std::span<const std::vector<uint8_t>> codestreams,
                                 std::span<const uint32_t> sample_crcs) {
  std::vector<uint8_t> section;
  uint64_t offset = codestreams.size() * kTopEntryBytes;
  for (size_t i = 0; i < codestreams.size(); ++i) {
    append_le(section, offset);
    append_le(section, static_cast<uint32_t>(codestreams[i].size()));
    append_le(section, sample_crcs[i]);
    offset += codestreams[i].size();
  }
  for (const auto& codestream : codestreams) {
    section.insert(section.end(), codestream.begin(), codestream.end());
  }
  return section;
}

std::vector<uint8_t> assemble_stream(const StreamHeader& header, const std::vector<uint8_t>& top,
                                     const IndexWriter& index, std::span<const uint8_t> rig) {
  StreamHeader complete = header;
  const std::span<const uint8_t> sections[] = {top, index.root, index.groups, index.tiles, rig};
  uint64_t offset = header_size(header);
  for (SectionEntry* entry : section_entries(complete)) {
    const bool is_rig = entry == &complete.rig;
    const auto place = is_rig ? 4 : entry - complete.sections.data();
    const std::span<const uint8_t> section = sections[place];
    *entry = {static_cast<uint32_t>(place + 1), crc32c(section), offset, section.size()};
    offset += section.size();
  }
  std::vector<uint8_t> bytes = write_header(complete);
  bytes.reserve(static_cast<size_t>(offset));
  for (const SectionEntry* entry : section_entries(complete)) {
    const auto section = sections[entry->type - 1];
    bytes.insert(bytes.end(), section.begin(), section.end());
  }
  return bytes;
}

}  // namespace hmlfc
