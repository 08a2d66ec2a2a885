#include "encoder/stream_assembly.hpp"

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

StreamHeader with_sections(const StreamHeader& header, const SectionSums& sections) {
  StreamHeader complete = header;
  uint64_t offset = header_size(header);
  for (SectionEntry* entry : section_entries(complete)) {
    const bool is_rig = entry == &complete.rig;
    const auto place = is_rig ? 4 : entry - complete.sections.data();
    const SectionSum& sum = sections[static_cast<size_t>(place)];
    *entry = {static_cast<uint32_t>(place + 1), sum.crc, offset, sum.size};
    offset += sum.size;
  }
  return complete;
}

std::vector<uint8_t> assemble_stream(const StreamHeader& header, const std::vector<uint8_t>& top,
                                     const IndexWriter& index, std::span<const uint8_t> rig) {
  const std::array<std::span<const uint8_t>, 5> sections{top, index.root, index.groups, index.tiles,
                                                         rig};
  SectionSums sums;
  for (size_t i = 0; i < sums.size(); ++i) sums[i].add(sections[i]);
  StreamHeader complete = with_sections(header, sums);
  std::vector<uint8_t> bytes = write_header(complete);
  for (const SectionEntry* entry : section_entries(complete)) {
    const auto section = sections[entry->type - 1];
    bytes.insert(bytes.end(), section.begin(), section.end());
  }
  return bytes;
}

}  // namespace hmlfc
