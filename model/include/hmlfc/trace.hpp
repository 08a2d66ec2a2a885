// The trace of one block: every field that the decoder reads and the values of every stage.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include <hmlfc/error.hpp>
#include <hmlfc/export.hpp>
#include <hmlfc/format.hpp>

namespace hmlfc {

/// Which tile of an image is read for a block.
enum class TileKind : uint8_t {
  kResidual,   ///< the tile that holds the block (section 5)
  kMotion,     ///< the motion tile that holds the block's motion (MOT-3)
  kDisparity,  ///< the motion tile of a reference image that holds the block's disparity (MOT-6)
};

/// "residual tile", "motion tile" or "disparity tile".
constexpr std::string_view tile_kind_name(TileKind kind) {
  constexpr std::string_view kNames[] = {"residual tile", "motion tile", "disparity tile"};
  return kNames[static_cast<size_t>(kind)];
}

/// One block of one image of the tree.
struct BlockSite {
  int level = 0;                        ///< [0, tree_height]
  uint32_t image_row = 0;               ///< in the level's grid of images
  uint32_t image_col = 0;               ///< in the level's grid of images
  Plane plane = Plane::kY;              ///< a plane of the image
  uint32_t bx = 0;                      ///< block column in the plane
  uint32_t by = 0;                      ///< block row in the plane
  TileKind tile = TileKind::kResidual;  ///< the tile that is read

  friend bool operator==(const BlockSite&, const BlockSite&) = default;
};

/// A field as it was read from the stream.
struct FieldRecord {
  BlockSite site;           ///< the block that was being read
  Section section;          ///< the section that holds the field
  uint64_t bit;             ///< address of its first bit from the start of the file (CNV-4)
  unsigned bits;            ///< length, [0, 64]
  std::string_view name;    ///< the specification's name
  std::string_view clause;  ///< the clause that defines it
  int64_t value;            ///< as the specification reads it: offset and sign applied
};

/// The values of one stage of a block, row by row: "parent", "reference" (ref of DEC-3 at the
/// displaced place, or R of MOT-9), "prediction", "residual" or "sample".
struct StageRecord {
  BlockSite site;                   ///< the block
  std::string_view stage;           ///< its name
  std::string_view clause;          ///< the clause that defines it
  std::span<const int32_t> values;  ///< block_size^2 values
};

/// A motion vector of a block.
struct VectorRecord {
  BlockSite site;           ///< the block
  uint32_t image_row = 0;   ///< of the reference image
  uint32_t image_col = 0;   ///< of the reference image
  int32_t x = 0;            ///< in eighths of a sample of the block's plane
  int32_t y = 0;            ///< likewise
  std::string_view clause;  ///< "MOT-8" or "TIL-7"
};

/// Receives the records of one block in the order of decoding. Reference blocks that are decoded on
/// demand report their fields, with their own site, before the stage that needs them.
class HMLFC_EXPORT TraceSink {
 public:
  virtual ~TraceSink() = default;

  /// A field was read. The record lives until the call returns.
  virtual void on_field(const FieldRecord& record) = 0;

  /// A stage is complete. The record and its values live until the call returns.
  virtual void on_stage(const StageRecord& record) = 0;
  /// Each vector, before the stage "parent" of its level.
  virtual void on_vector(const VectorRecord& record) { static_cast<void>(record); }
};

/// The cost of decoding; BND-1 to BND-3 bound each count.
struct AccessCounts {
  uint64_t walks = 0;   ///< entries of blocks, motion blocks and disparities looked up
  uint64_t fields = 0;  ///< fields read
  uint64_t bits = 0;    ///< bits of these fields
  uint64_t steps = 0;   ///< serial additions over block headers
};

}  // namespace hmlfc
