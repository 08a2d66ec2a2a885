// Everything the golden model reports about one block, kept.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <hmlfc/trace.hpp>

namespace hmlfc::vectors {

/// A StageRecord with its values.
struct RecordedStage {
  BlockSite site;
  std::string stage;
  std::string clause;
  std::vector<int32_t> values;
};

/// A FieldRecord; its names live as long as the program.
using RecordedField = FieldRecord;

/// Keeps fields and stages in the order in which they are reported.
class BlockRecorder final : public TraceSink {
 public:
  void on_field(const FieldRecord& record) override { records.emplace_back(record); }
  void on_stage(const StageRecord& record) override {
    records.emplace_back(RecordedStage{record.site,
                                       std::string(record.stage),
                                       std::string(record.clause),
                                       {record.values.begin(), record.values.end()}});
  }

  std::vector<std::variant<RecordedField, RecordedStage>> records;
};

}  // namespace hmlfc::vectors
