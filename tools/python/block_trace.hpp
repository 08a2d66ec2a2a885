// The trace of a block as Python objects.
#pragma once

#include <string>
#include <vector>

#include <hmlfc/trace.hpp>

#include "python/object.hpp"

namespace hmlfc::python {

/// Records the fields, vectors and stages of a block, without the GIL; makes lists of dicts of
/// them, with it.
class BlockTrace : public TraceSink {
 public:
  void on_field(const FieldRecord& record) override { fields_.push_back(record); }
  void on_stage(const StageRecord& record) override {
    stages_.push_back({record, {record.values.begin(), record.values.end()}});
  }
  void on_vector(const VectorRecord& record) override { vectors_.push_back(record); }

  /// level, image, plane, block, tile, section, byte, bit, bits, name, clause, value.
  Object fields() const;
  /// level, image, plane, block, reference, vector, clause.
  Object vectors() const;
  /// level, image, plane, block, stage, clause, values: (side, side) int32.
  Object stages(size_t side) const;

 private:
  struct Stage {
    StageRecord record;  // its values are those below
    std::vector<int32_t> values;
  };

  std::vector<FieldRecord> fields_;
  std::vector<Stage> stages_;
  std::vector<VectorRecord> vectors_;
};

}  // namespace hmlfc::python
