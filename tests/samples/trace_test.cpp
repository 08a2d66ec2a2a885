// What a sink is told while a block is decoded: fields that stand in the file where they are said
// to stand, and the values of every stage (CNV-4, DEC-3, DEC-4, TIL-10).
#include <cstdint>
#include <random>
#include <string_view>

#include <gtest/gtest.h>

#include <hmlfc/decoder.hpp>

#include "bits/naive_bits.hpp"
#include "samples/naive_stream.hpp"

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
    // Values within a BISE group have no bits of their own.
    if (record.name == "value" || record.name == "dx" || record.name == "dy") return;
    ASSERT_LE(record.bit + record.bits, file_.size());
    uint64_t raw = file_.field(record.bit, record.bits);
    if (record.name == "bias" && record.bits > 0 && file_[record.bit + record.bits - 1]) {
      raw -= record.bits < 64 ? uint64_t{1} << record.bits : 0;
    }
    const bool least = record.name == "min_x" || record.name == "min_y";
    const int64_t offset = least ? -stream_.header().window : 0;
    ASSERT_EQ(record.value, static_cast<int64_t>(raw) + offset)
        << record.name << " at bit " << record.bit;
  }

  void on_stage(const StageRecord& record) override {
    ++stages_;
    const BlockSite& site = record.site;
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

 private:
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
};

TEST(Trace, FieldsAndStagesOfRandomStreams) {
  std::mt19937 random(1);
  int fields = 0;
  int stages = 0;
  for (int round = 0; round < 20; ++round) {
    const NaiveStream stream(random, test::draw_stream_header(random), 3);
    const StreamHeader& header = stream.header();
    const Bytes file = stream.file();
    const NaiveBits bits(file);
    const auto decoder = Decoder::open(file);
    ASSERT_TRUE(decoder.has_value());
    for (int i = 0; i < 40; ++i) {
      const Plane plane = kPlanes[random() % 3];
      const NaiveSize blocks = stream.tree().plane_blocks(plane);
      const auto below = [&](uint32_t end) { return static_cast<uint32_t>(random() % end); };
      const BlockAddress at{{below(header.rows), below(header.cols)},
                            plane,
                            below(blocks.width),
                            below(blocks.height)};
      Checker checker(stream, bits);
      ASSERT_TRUE(decoder->decode_block(at, 0, &checker).has_value());
      ASSERT_FALSE(HasFailure());
      fields += checker.fields();
      stages += checker.stages();
    }
  }
  EXPECT_GT(fields, 10000);
  EXPECT_GT(stages, 2000);
}

}  // namespace
}  // namespace hmlfc
