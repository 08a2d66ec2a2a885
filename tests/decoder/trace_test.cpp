// What a sink is told while a block is decoded: fields that stand in the file where they are said
// to stand, and stages that follow from each other (CNV-4, DEC-3, DEC-4, TIL-10, MOT-9, STP-3).
// The vectors' traces have the values of every stage.
#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include <hmlfc/decoder.hpp>

#include "arithmetic/reconstruct.hpp"
#include "bits/naive_bits.hpp"
#include "support/streams.hpp"
#include "syntax/geometry.hpp"
#include "vectors/field_stream.hpp"

namespace hmlfc {
namespace {

using test::Bytes;
using test::NaiveBits;
using Values = std::vector<int32_t>;

/// Fields, stages by name and clause, and predicted samples that were clamped.
struct Told {
  int fields = 0;
  std::map<std::string, int> stages;
  int clamped = 0;
};

/// Compares each field with the file's bits, and the stages of each level with each other.
class Checker final : public TraceSink {
 public:
  Checker(const StreamHeader& header, const NaiveBits& file, Told& told)
      : header_(header), geometry_(header), file_(file), told_(told) {}

  void on_field(const FieldRecord& record) override {
    ++told_.fields;
    ASSERT_NO_FATAL_FAILURE(check_kind(record));
    // Values within a BISE group have no bits of their own.
    if (kOfSequences.contains(record.name)) return;
    ASSERT_LE(record.bit + record.bits, file_.size());
    uint64_t raw = file_.field(record.bit, record.bits);
    if (kSigned.contains(record.name) && record.bits > 0 && file_[record.bit + record.bits - 1]) {
      raw -= record.bits < 64 ? uint64_t{1} << record.bits : 0;
    }
    const bool least = record.name == "min_x" || record.name == "min_y";
    ASSERT_EQ(record.value, static_cast<int64_t>(raw) - (least ? header_.window : 0))
        << record.name << " at bit " << record.bit;
  }

  void on_stage(const StageRecord& record) override {
    ++told_.stages[std::string(record.stage) + " " + std::string(record.clause)];
    ASSERT_EQ(record.site.tile, TileKind::kResidual);
    const size_t samples = size_t{header_.block_size()} * header_.block_size();
    ASSERT_EQ(record.values.size(), samples);
    const Values values(record.values.begin(), record.values.end());
    if (record.stage == "parent") {
      parent_ = values_.contains("sample") ? values_["sample"] : Values(samples);
      values_.clear();
    }
    values_[std::string(record.stage)] = values;
    if (record.stage == "sample" && record.clause == "DEC-3") check_level(record.site);
  }

  /// The samples of the last stage.
  const Values& samples() { return values_["sample"]; }

 private:
  static inline const std::set<std::string_view> kOfSequences{"value", "dx", "dy", "index",
                                                              "disparity"};
  static inline const std::set<std::string_view> kSigned{"bias", "explicit_x", "explicit_y",
                                                         "min_disparity"};

  // Which tile a field stands in, and whose image's.
  void check_kind(const FieldRecord& record) const {
    const BlockSite& site = record.site;
    const bool reference = geometry_.is_reference(site.level, {site.image_row, site.image_col});
    const std::string_view clause = record.clause;
    if (clause == "MOT-3") {
      ASSERT_EQ(site.tile, TileKind::kMotion);
    }
    if (clause == "MOT-6") {
      ASSERT_EQ(site.tile, TileKind::kDisparity);
    }
    if (clause.starts_with("TIL") || clause.starts_with("STP")) {
      ASSERT_EQ(site.tile, TileKind::kResidual);
    }
    if (site.tile != TileKind::kResidual) {
      ASSERT_EQ(reference, site.tile == TileKind::kDisparity);
    }
  }

  // DEC-3 with either sign; P of EXT-5 (TRC-1).
  void check_level(const BlockSite& site) {
    const PlaneShape& plane = geometry_.plane(site.plane);
    const SampleRange range = sample_range(site.plane, header_.depth);
    const uint32_t side = header_.block_size();
    const bool from_key = geometry_.level(site.level).keyed && values_.contains("reference");
    ASSERT_EQ(values_["parent"], from_key ? Values(parent_.size()) : parent_);
    for (uint32_t i = 0; i < side * side; ++i) {
      if (site.bx * side + i % side >= plane.width || site.by * side + i / side >= plane.height) {
        continue;
      }
      const auto value = [&](const char* stage) {
        return values_.contains(stage) ? values_[stage][i] : 0;
      };
      const auto clamped = [&](int32_t x) { return std::clamp(x, range.lo, range.hi); };
      const int32_t prediction = value("prediction");
      ASSERT_EQ(value("sample"), clamped(prediction + value("residual")));
      const int32_t plus = value("parent") + value("reference");
      const int32_t minus = value("parent") - value("reference");
      ASSERT_TRUE(prediction == clamped(plus) || prediction == clamped(minus));
      if (prediction != plus && prediction != minus) ++told_.clamped;
    }
  }

  StreamHeader header_;
  Geometry geometry_;
  const NaiveBits& file_;
  Told& told_;
  std::map<std::string, Values> values_;
  Values parent_;
};

// What 40 random blocks of each of `streams` random streams tell.
Told check_streams(const vectors::Limits& limits, int streams) {
  Told told;
  vectors::Random random(1);
  for (int round = 0; round < streams; ++round) {
    const Bytes file = vectors::random_stream(random.next(), limits);
    const NaiveBits bits(file);
    const auto decoder = Decoder::open(file);
    const StreamHeader& header = decoder->header();
    for (int i = 0; i < 40; ++i) {
      const BlockAddress at = test::draw_block(random, *decoder);
      Checker checker(header, bits, told);
      const Values block = decoder->decode_block(at, {.trace = &checker}).value();
      EXPECT_EQ(block, checker.samples());
    }
    EXPECT_FALSE(testing::Test::HasFailure()) << "round " << round;
    if (testing::Test::HasFailure()) break;
  }
  return told;
}

TEST(Trace, FieldsAndStagesOfProfileMain) {
  Told told = check_streams({.extended = false}, 40);
  EXPECT_GT(told.fields, 10000);
  EXPECT_GT(told.stages["reference DEC-4"], 200);
  EXPECT_GT(told.clamped, 200);
  EXPECT_EQ(told.stages.count("residual STP-3") + told.stages.count("reference MOT-9"), 0u);
}

TEST(Trace, FieldsAndStagesOfProfileExtended) {
  Told told = check_streams({.main = false}, 60);
  EXPECT_GT(told.fields, 30000);
  for (const char* name : {"parent DEC-3", "reference MOT-9", "reference DEC-4", "prediction DEC-3",
                           "residual STP-3", "residual TIL-10", "sample DEC-3", "sample DEC-2"}) {
    EXPECT_GT(told.stages[name], 20) << name;
  }
}

}  // namespace
}  // namespace hmlfc
