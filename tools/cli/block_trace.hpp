// Everything a decoder reported about one block, in order.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <hmlfc/decoder.hpp>
#include <hmlfc/trace.hpp>

namespace hmlfc::cli {

struct TracedField {
  Section section;
  uint64_t bit;
  unsigned bits;
  std::string name;
  std::string clause;
  int64_t value;
};

/// The fields read for one block of one image from one tile.
struct TracedWalk {
  BlockSite site;
  std::vector<TracedField> fields;
};

struct TracedStage {
  std::string name;
  std::string clause;
  std::vector<int32_t> values;  ///< row by row
};

/// One step down the tree.
struct TracedLevel {
  BlockSite site;
  /// The block itself, or its motion tile, its disparity and then itself (MOT-10); after that the
  /// reference blocks it needed.
  std::vector<TracedWalk> walks;
  std::vector<TracedStage> stages;

  /// The walk to the block's own entry, or null.
  const TracedWalk* own_walk() const;

  /// The walk to the block's motion or its disparity, or null.
  const TracedWalk* walk(TileKind kind) const;

  /// Whether `walk` is one to a reference block.
  bool is_reference(const TracedWalk& walk) const;

  /// The stage of this name, or null.
  const TracedStage* stage(std::string_view name) const;

  /// The block's own state, told by its stages; meaningless for a key image.
  BlockState state() const;
};

/// Records the decoding of one block; every record of a level comes before those of the next.
class BlockTrace final : public TraceSink {
 public:
  void on_field(const FieldRecord& record) override;
  void on_stage(const StageRecord& record) override;

  /// From the top level down.
  const std::vector<TracedLevel>& levels() const { return levels_; }

 private:
  TracedLevel& level_of(const BlockSite& site);

  std::vector<TracedLevel> levels_;
};

/// What `inspect` shows.
struct BlockReport {
  std::string file;
  StreamHeader header;
  BlockAddress block;
  BlockTrace trace;
  AccessCounts counts;
};

}  // namespace hmlfc::cli
