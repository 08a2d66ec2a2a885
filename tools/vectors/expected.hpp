// The golden model's results for a stream: pictures, checksums of blocks, traces.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <hmlfc/decoder.hpp>
#include <hmlfc/trace.hpp>

#include "vectors/json.hpp"

namespace hmlfc::vectors {

/// Calls body(block) for each block of all views, plane by plane and row by row.
template <class Body>
void for_each_block(const Decoder& decoder, const Body& body) {
  const StreamHeader& header = decoder.header();
  const uint32_t side = header.block_size();
  for (uint32_t view = 0; view < header.rows * header.cols; ++view) {
    for (const Plane plane : kPlanes) {
      const PlaneSize size = decoder.plane_size(plane);
      for (uint32_t by = 0; by * side < size.height; ++by) {
        for (uint32_t bx = 0; bx * side < size.width; ++bx) {
          body(BlockAddress{{view / header.cols, view % header.cols}, plane, bx, by});
        }
      }
    }
  }
}

/// All views of a stream as bytes and the checksums of their blocks.
struct ExpectedViews {
  std::optional<std::vector<uint8_t>> raw;  ///< all views, row by row; none if a block fails
  std::string blocks;                       ///< the blocks file (vectors/README.md)
};

/// Decodes all views of `decoder` block by block.
ExpectedViews expected_views(const Decoder& decoder);

/// A StageRecord with its values.
struct RecordedStage {
  BlockSite site;
  std::string stage;
  std::string clause;
  std::vector<int32_t> values;
};

inline RecordedStage recorded(const StageRecord& record) {
  return {record.site,
          std::string(record.stage),
          std::string(record.clause),
          {record.values.begin(), record.values.end()}};
}

/// A FieldRecord; its names live as long as the program.
using RecordedField = FieldRecord;

/// Collects fields and stages in the order in which they are reported.
class BlockRecorder final : public TraceSink {
 public:
  void on_field(const FieldRecord& record) override { records.emplace_back(record); }
  void on_stage(const StageRecord& record) override { records.emplace_back(recorded(record)); }

  std::vector<std::variant<RecordedField, RecordedStage>> records;
};

/// The value of `field` as JSON; 64-bit values are unsigned.
Json value_json(const RecordedField& field);

/// Both forms of one trace.
struct TraceText {
  std::string lines;  ///< JSON lines
  std::string hex;    ///< words for $readmemh
};

/// Every field and stage of `blocks`, which all decode, reference blocks on demand.
TraceText trace_text(const Decoder& decoder, std::span<const BlockAddress> blocks);

}  // namespace hmlfc::vectors
