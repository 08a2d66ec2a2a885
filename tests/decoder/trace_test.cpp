// A sink is told every field at the place where it stands in the file (CNV-4), and the stages.
// naive.traces has the values of every stage.
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include <hmlfc/decoder.hpp>

#include "bits/naive_bits.hpp"
#include "support/streams.hpp"
#include "syntax/geometry.hpp"
#include "vectors/field_stream.hpp"

namespace hmlfc {
namespace {

using test::Bytes;
using test::NaiveBits;
using Values = std::vector<int32_t>;

/// Fields, and stages by name and clause.
struct Told {
  int fields = 0;
  std::map<std::string, int> stages;
};

/// Compares each field with the file's bits.
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
    samples_.assign(record.values.begin(), record.values.end());
  }

  /// Values of the last stage.
  const Values& samples() const { return samples_; }

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

  StreamHeader header_;
  Geometry geometry_;
  const NaiveBits& file_;
  Told& told_;
  Values samples_;
};

// Collects what 40 random blocks of each of `streams` random streams tell.
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
