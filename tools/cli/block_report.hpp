// What `inspect` shows: everything a decoder reported about one block.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <hmlfc/decoder.hpp>
#include <hmlfc/trace.hpp>

#include "cli/output.hpp"
#include "vectors/expected.hpp"

namespace hmlfc::cli {

/// The fields read for one block of one image from one tile.
struct TracedWalk {
  BlockSite site;
  std::vector<FieldRecord> fields;  ///< their names live as long as the program
};

using vectors::RecordedStage;

/// One step down the tree.
struct TracedLevel {
  BlockSite site;
  /// The block itself, or its motion tile, its disparity and then itself (MOT-10); after that the
  /// reference blocks it needed.
  std::vector<TracedWalk> walks;
  std::vector<VectorRecord> vectors;  ///< one for each reference image used
  std::vector<RecordedStage> stages;

  /// The walk to the block's own entry, or null.
  const TracedWalk* own_walk() const;

  /// The walk to the block's motion or its disparity, or null.
  const TracedWalk* walk(TileKind kind) const;

  /// Whether `walk` is one to a reference block.
  bool is_reference(const TracedWalk& walk) const;

  /// The stage of this name, or null.
  const RecordedStage* stage(std::string_view name) const;

  /// The block's own state, derived from its stages; meaningless for a key image.
  BlockState state() const;
};

/// Records the decoding of one block; every record of a level comes before those of the next.
class BlockTrace final : public TraceSink {
 public:
  void on_field(const FieldRecord& record) override;
  void on_stage(const StageRecord& record) override;
  void on_vector(const VectorRecord& record) override {
    level_of(record.site).vectors.push_back(record);
  }

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
  PlaneSize plane_size;  ///< of the block's plane
  BlockTrace trace;
  AccessCounts counts;
};

/// The unit of the value of `field`, one of `walk`, such as "samples" or "1/4 sample"; empty for a
/// pure number.
std::string unit_of(const TracedWalk& walk, const FieldRecord& field, const StreamHeader& header);

/// The fields of `walk` as a table for people, each line after `indent` spaces: masks in
/// hexadecimal, codes with their meaning, the values of a residual block as one row.
std::string field_table(const TracedWalk& walk, const StreamHeader& header, size_t indent);

/// The keys that `hmlfc inspect --help` lists; levels from the top, values as rows of the block.
Json to_json(const BlockReport& report);

std::string to_text(const BlockReport& report);

}  // namespace hmlfc::cli
