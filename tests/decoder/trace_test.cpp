// What a sink is told while a block is decoded: fields that stand in the file where they are said
// to stand, and the values of every stage (CNV-4, DEC-3, DEC-4, TIL-10, MOT-9, STP-3).
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include <hmlfc/decoder.hpp>

#include "bits/naive_bits.hpp"
#include "decoder/naive_stream.hpp"

namespace hmlfc {
namespace {

using test::Bytes;
using test::NaiveBits;
using test::NaiveImage;
using test::NaiveSize;
using test::NaiveStream;

/// Compares each record with the file's bits and the naive stream's values.
class Checker final : public TraceSink {
 public:
  Checker(const NaiveStream& stream, const NaiveBits& file) : stream_(stream), file_(file) {}

  void on_field(const FieldRecord& record) override {
    ++fields_;
    ASSERT_NO_FATAL_FAILURE(check_kind(record));
    // Values within a BISE group have no bits of their own.
    if (kOfSequences.contains(record.name)) return;
    ASSERT_LE(record.bit + record.bits, file_.size());
    uint64_t raw = file_.field(record.bit, record.bits);
    if (kSigned.contains(record.name) && record.bits > 0 && file_[record.bit + record.bits - 1]) {
      raw -= record.bits < 64 ? uint64_t{1} << record.bits : 0;
    }
    const bool least = record.name == "min_x" || record.name == "min_y";
    const int64_t offset = least ? -stream_.header().window : 0;
    ASSERT_EQ(record.value, static_cast<int64_t>(raw) + offset)
        << record.name << " at bit " << record.bit;
  }

  void on_stage(const StageRecord& record) override {
    ++stages_;
    ++names_[std::string(record.stage) + " " + std::string(record.clause)];
    const BlockSite& site = record.site;
    ASSERT_EQ(site.tile, TileKind::kResidual);
    const NaiveImage image{site.level, site.image_row, site.image_col};
    const NaiveSize size = stream_.tree().plane_size(site.plane);
    const uint32_t side = stream_.header().block_size();
    ASSERT_EQ(record.values.size(), size_t{side} * side);
    for (uint32_t i = 0; i < side * side; ++i) {
      const uint32_t x = site.bx * side + i % side;
      const uint32_t y = site.by * side + i / side;
      if (x >= size.width || y >= size.height) continue;
      ASSERT_EQ(record.values[i], expected(record.stage, image, site.plane, x, y))
          << record.stage << " at " << x << ", " << y << " of level " << site.level;
    }
  }

  int fields() const { return fields_; }
  int stages() const { return stages_; }
  const std::map<std::string, int>& names() const { return names_; }

 private:
  static inline const std::set<std::string_view> kOfSequences{"value", "dx", "dy", "index",
                                                              "disparity"};
  static inline const std::set<std::string_view> kSigned{"bias", "explicit_x", "explicit_y",
                                                         "min_disparity"};

  // Which tile a field stands in, and whose image's.
  void check_kind(const FieldRecord& record) const {
    const BlockSite& site = record.site;
    const NaiveImage image{site.level, site.image_row, site.image_col};
    const bool reference = stream_.tree().reference(image) == image;
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

  int64_t expected(std::string_view stage, const NaiveImage& image, Plane plane, uint32_t x,
                   uint32_t y) const {
    if (stage == "sample") return stream_.sample(image, plane, x, y);
    if (stage == "parent") return stream_.parent_sample(image, plane, x, y);
    if (stage == "reference") return stream_.displaced(image, plane, x, y);
    if (stage == "prediction") return stream_.prediction(image, plane, x, y);
    if (stage == "residual") return stream_.residual(image, plane, x, y);
    ADD_FAILURE() << "a stage " << stage;
    return 0;
  }

  const NaiveStream& stream_;
  const NaiveBits& file_;
  int fields_ = 0;
  int stages_ = 0;
  std::map<std::string, int> names_;
};

// Fields, stages and the names of the stages of 40 random blocks.
struct Told {
  int fields = 0;
  int stages = 0;
  std::map<std::string, int> names;
};

void check_stream(std::mt19937& random, const NaiveStream& stream, Told& told) {
  const Bytes file = stream.file();
  const NaiveBits bits(file);
  const auto decoder = Decoder::open(file);
  ASSERT_TRUE(decoder.has_value());
  for (int i = 0; i < 40; ++i) {
    const BlockAddress at = test::draw_block(random, stream);
    Checker checker(stream, bits);
    ASSERT_TRUE(decoder->decode_block(at, {.trace = &checker}).has_value());
    ASSERT_FALSE(testing::Test::HasFailure());
    told.fields += checker.fields();
    told.stages += checker.stages();
    for (const auto& [name, count] : checker.names()) told.names[name] += count;
  }
}

TEST(Trace, FieldsAndStagesOfRandomStreams) {
  std::mt19937 random(1);
  Told told;
  for (int round = 0; round < 20; ++round) {
    const NaiveStream stream(random, test::draw_stream_header(random), 3);
    ASSERT_NO_FATAL_FAILURE(check_stream(random, stream, told)) << "round " << round;
  }
  EXPECT_GT(told.fields, 10000);
  EXPECT_GT(told.stages, 2000);
  EXPECT_EQ(told.names.count("residual STP-3") + told.names.count("reference MOT-9"), 0u);
}

TEST(Trace, FieldsAndStagesOfExtendedStreams) {
  std::mt19937 random(2);
  Told told;
  for (int round = 0; round < 60; ++round) {
    uint32_t flags = test::draw_flags(random);
    if (round % 4 == 0) flags &= ~uint32_t{62};  // vectors in residual tiles
    const NaiveStream stream(random, test::draw_extended_header(random, flags), 3);
    ASSERT_NO_FATAL_FAILURE(check_stream(random, stream, told)) << "round " << round;
  }
  EXPECT_GT(told.fields, 30000);
  for (const char* name : {"parent DEC-3", "reference MOT-9", "reference DEC-4", "prediction DEC-3",
                           "residual STP-3", "residual TIL-10", "sample DEC-3", "sample DEC-2"}) {
    EXPECT_GT(told.names[name], 20) << name;
  }
}

}  // namespace
}  // namespace hmlfc
