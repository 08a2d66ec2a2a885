// What the tests of motion tiles and of disparities share.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

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

/// Fields as a sink is told.
class FieldRecorder final : public TraceSink {
 public:
  explicit FieldRecorder(std::string_view clause) : clause_(clause) {}

  void on_field(const FieldRecord& record) override {
    EXPECT_EQ(record.section, Section::kTile);
    EXPECT_EQ(record.clause, clause_);
    text_ += std::string(record.name) + "@" + std::to_string(record.bit) + ":" +
             std::to_string(record.bits) + "=" + std::to_string(record.value) + " ";
  }
  void on_stage(const StageRecord&) override {}
  const std::string& text() const { return text_; }

 private:
  std::string_view clause_;
  std::string text_;
};

}  // namespace hmlfc::test
