// What the tests of tile records, motion tiles and disparities share.
#pragma once

#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include <hmlfc/error.hpp>
#include <hmlfc/trace.hpp>

namespace hmlfc::test {

inline constexpr uint64_t kRecordAt = 1000;  ///< byte of the file at which the record stands

/// The name of the error, which stands in the record.
inline std::string name_of(const Error& error) {
  EXPECT_EQ(error.section, Section::kTile);
  EXPECT_GE(error.offset, kRecordAt);
  return std::string(error_name(error.code));
}

/// Fields as a sink is told, one a line: clause, name, bit in the record, number of bits and value.
class FieldRecorder final : public TraceSink {
 public:
  void on_field(const FieldRecord& record) override {
    EXPECT_EQ(record.section, Section::kTile);
    text_ += std::string(record.clause) + " " + std::string(record.name) + "@" +
             std::to_string(record.bit - 8 * kRecordAt) + ":" + std::to_string(record.bits) + "=" +
             std::to_string(record.value) + "\n";
  }
  void on_stage(const StageRecord&) override {}
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace hmlfc::test
