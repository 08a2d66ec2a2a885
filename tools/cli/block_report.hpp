// What `inspect` shows: everything a decoder reported about one block.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
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

  /// The value of the last field of this name.
  std::optional<int64_t> last_value(std::string_view name) const;

  /// The level code of the block at which the walk ends (TIL-8); none without residual.
  std::optional<unsigned> level_code() const;

  /// The step code of that block (STP-1); none without residual_step or residual.
  std::optional<unsigned> step_code() const;
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

/// A field as people read it, or several in a row with the same name.
struct FieldRow {
  std::string section;
  uint64_t first_bit = 0;  ///< from the start of the file (CNV-4)
  uint64_t bit_count = 0;  ///< of all its fields
  std::string bits;        ///< "64", or "33 x 3"
  std::string name;
  std::string value;  ///< with what it means in brackets
  std::string clause;

  /// "0x0001f4.3": byte in hexadecimal, bit.
  std::string address() const;
};

/// A row of `walk` for each field, or for a run of repeated ones.
std::vector<FieldRow> field_rows(const TracedWalk& walk, const StreamHeader& header);

/// What kind of image a level of a trace is, and the block's state in it.
std::string describe_image(const TracedLevel& level, const StreamHeader& header);

/// Which tile `walk`, one of `level`, reads.
std::string describe_walk(const TracedLevel& level, const TracedWalk& walk);

/// The arithmetic of DEC-3 and TIL-10 with the numbers of a block of `plane`, a formula a line;
/// empty where there is none.
std::string formulas(const TracedLevel& level, const StreamHeader& header, Plane plane);

/// The fields of `walk` as a table for people, each line after `indent` spaces: masks in
/// hexadecimal, codes with their meaning, the values of a residual block as one row.
std::string field_table(const TracedWalk& walk, const StreamHeader& header, size_t indent);

/// The keys that `hmlfc inspect --help` lists; levels from the top, values as rows of the block.
Json to_json(const BlockReport& report);

std::string to_text(const BlockReport& report);

}  // namespace hmlfc::cli
