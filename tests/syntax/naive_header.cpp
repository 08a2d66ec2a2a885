#include "syntax/naive_header.hpp"

#include <span>

#include "bits/naive_bits.hpp"
#include "bits/naive_crc32c.hpp"

namespace hmlfc::test {

void patch(Bytes& bytes, size_t offset, unsigned size, uint64_t value) {
  for (unsigned i = 0; i < size; ++i) bytes[offset + i] = static_cast<uint8_t>(value >> (8 * i));
}

void seal(Bytes& file) {
  const size_t size = size_t{file[10]} + 256 * size_t{file[11]};
  if (size < 16 || size > file.size()) return;
  patch(file, size - 4, 4, naive_crc32c(std::span(file).first(size - 4)));
}

Bytes naive_header(const StreamHeader& h) {
  const auto levels = static_cast<unsigned>(h.tree_height) + 1;
  NaiveBits bits;
  for (const unsigned byte : {0x89u, 0x48u, 0x4Du, 0x4Cu, 0x46u, 0x43u, 0x0Du, 0x0Au}) {
    bits.put(byte, 8);
  }
  bits.put(1, 8).put(static_cast<uint64_t>(h.profile), 8).put(44 + 4 * levels + 96 + 4, 16);
  bits.put(h.feature_flags, 32).put(h.rows, 16).put(h.cols, 16).put(h.width, 32).put(h.height, 32);
  bits.put(static_cast<unsigned>(h.depth), 8).put(static_cast<uint64_t>(h.chroma_format), 8);
  bits.put(h.block_log2, 8).put(static_cast<unsigned>(h.window), 8);
  bits.put(h.cluster_rows, 8).put(h.cluster_cols, 8).put(levels - 1, 8);
  bits.put(h.vector_precision, 8).put(h.disparity_precision, 8).put(h.motion_tile_log2, 8);
  bits.put(h.disparity_grid_log2, 8).put_signed(h.row_scale, 8).put(0, 32);
  for (size_t level = levels; level-- > 0;) {
    bits.put(h.levels[level].ref_rows, 8).put(h.levels[level].ref_cols, 8);
    bits.put(h.levels[level].key_references, 8).put(0, 8);
  }
  for (const SectionEntry& entry : h.sections) {
    bits.put(entry.type, 32).put(entry.crc, 32).put(entry.offset, 64).put(entry.size, 64);
  }
  bits.put(0, 32);
  Bytes bytes = bits.bytes();
  seal(bytes);
  return bytes;
}

Bytes naive_file(StreamHeader header, const SectionBytes& sections) {
  uint64_t offset = 44 + 4 * (static_cast<uint64_t>(header.tree_height) + 1) + 96 + 4;
  for (uint32_t i = 0; i < 4; ++i) {
    header.sections[i] = {i + 1, naive_crc32c(sections[i]), offset, sections[i].size()};
    offset += sections[i].size();
  }
  Bytes file = naive_header(header);
  for (const Bytes& section : sections) file.insert(file.end(), section.begin(), section.end());
  return file;
}

StreamHeader some_header(int tree_height) {
  StreamHeader header;
  header.rows = 5;
  header.cols = 7;
  header.width = 100;
  header.height = 60;
  header.depth = 10;
  header.chroma_format = ChromaFormat::k444;
  header.block_log2 = 2;
  header.window = 16;
  header.cluster_rows = 2;
  header.cluster_cols = 3;
  header.tree_height = tree_height;
  for (int level = 0; level <= tree_height; ++level) {
    header.levels.push_back({static_cast<uint8_t>(level + 1), static_cast<uint8_t>(level + 2)});
  }
  return header;
}

}  // namespace hmlfc::test
