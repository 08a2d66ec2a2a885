// Writing the sections ROOT, GROUP and TILE (IDX-3 to IDX-6).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace hmlfc {

/// What IDX-4 to IDX-6 leave open; the default takes the fewest bytes.
struct IndexLayout {
  unsigned least_offset_bits = 1;  ///< [1, 32]
  unsigned spare_records = 0;      ///< group records before the first that is used
  unsigned spare_bytes = 0;        ///< bytes of TILE before the data of each group
  bool records_of_empty = false;   ///< groups without a tile have a record, of mask 0
};

/// Collects the tile records of a stream in the order of their tile numbers.
class IndexWriter {
 public:
  explicit IndexWriter(const IndexLayout& layout = {});

  /// Appends tile number 0, 1, 2, ...; an empty record stands for an empty tile.
  void add(std::span<const uint8_t> record);

  /// Ends the last group. Afterwards the sections can be taken.
  void finish();

  std::vector<uint8_t> root;
  std::vector<uint8_t> groups;
  std::vector<uint8_t> tiles;

 private:
  void flush_group();
  void flush_root_entry();

  IndexLayout layout_;
  uint64_t next_tile_ = 0;
  uint64_t groups_done_ = 0;

  uint64_t tile_mask_ = 0;
  std::vector<uint64_t> ends_;
  std::vector<uint8_t> records_;

  uint64_t group_mask_ = 0;
  uint64_t first_record_ = 0;
};

}  // namespace hmlfc
