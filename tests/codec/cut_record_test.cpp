// A tile record that ends too early: tile_overrun for each block that needs the missing bytes.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include <hmlfc/decoder.hpp>
#include <hmlfc/encoder.hpp>

#include "bits/little_endian.hpp"
#include "scenes/test_light_fields.hpp"

namespace hmlfc {
namespace {

constexpr uint32_t kWidth = 30;
constexpr uint32_t kHeight = 22;

// Two grey views, the second with a little noise and a parallax of one to three samples: the only
// tile record is that of its plane Y.
LightField two_grey_views() {
  LightField field({1, 2, kWidth, kHeight, 8});
  test::Random random(1);
  std::vector<uint16_t> first(size_t{kWidth} * 3);
  std::vector<uint16_t> second(size_t{kWidth} * 3);
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint16_t& sample : first) sample = static_cast<uint16_t>(random() % 256);
    for (uint32_t x = 0; x < kWidth * 3; ++x) first[x] = first[x / 3 * 3];
    for (uint32_t x = 0; x < kWidth; ++x) {
      const uint32_t parallax = 1 + y / 4 % 3;
      const uint16_t moved = first[std::min(x + parallax, kWidth - 1) * 3];
      std::fill_n(second.begin() + x * 3, 3, static_cast<uint16_t>(moved ^ (random() % 2)));
    }
    field.write_row(0, 0, y, first);
    field.write_row(0, 1, y, second);
  }
  return field;
}

std::vector<uint8_t> stream_of_one_record(uint32_t threshold) {
  EncodeParams params;
  params.profile = Profile::kMain;
  params.method = Method::kMc;
  params.window = 3;
  params.main.threshold_pred = threshold;
  return encode(two_grey_views(), params)->bytes;
}

// The end-table entry of a stream's only record (IDX-6): a table of at most two bytes, with which
// the TILE section begins.
struct OnlyEnd {
  explicit OnlyEnd(const std::vector<uint8_t>& file) {
    const auto header = Decoder::open(file)->header();
    const SectionEntry& groups = header.sections[2];
    const auto group = static_cast<size_t>(groups.offset);
    is_there = groups.size == 16 && std::popcount(load_le<uint64_t>(file, group)) == 1;
    if (!is_there) return;
    table_bytes = file[group + 14] > 8 ? 2 : 1;
    at = static_cast<size_t>(header.sections[3].offset);
    record_bytes = static_cast<size_t>(header.sections[3].size) - table_bytes;
  }

  // The file with the record cut to `end` bytes.
  std::vector<uint8_t> cut(std::vector<uint8_t> file, size_t end) const {
    for (size_t i = 0; i < table_bytes; ++i) file[at + i] = static_cast<uint8_t>(end >> (8 * i));
    return file;
  }

  bool is_there = false;
  size_t record_bytes = 0;  // of the whole record
  size_t table_bytes = 0;
  size_t at = 0;
};

class CutRecord : public ::testing::TestWithParam<uint32_t> {};

TEST_P(CutRecord, OverrunsWhereBytesAreMissing) {
  const std::vector<uint8_t> whole = stream_of_one_record(GetParam());
  const OnlyEnd only(whole);
  ASSERT_TRUE(only.is_there);
  ASSERT_EQ(only.cut(whole, only.record_bytes), whole);
  OpenOptions options;
  options.check_sections = false;
  const auto intact = Decoder::open(whole);
  size_t unharmed = 0;
  for (size_t end = 1; end < only.record_bytes; ++end) {
    const std::vector<uint8_t> file = only.cut(whole, end);
    const auto decoder = Decoder::open(file, options);
    ASSERT_TRUE(decoder.has_value());
    size_t failed = 0;
    for (uint32_t by = 0; by * 4 < kHeight; ++by) {
      for (uint32_t bx = 0; bx * 4 < kWidth; ++bx) {
        const BlockAddress address{{0, 1}, Plane::kY, bx, by};
        const auto block = decoder->decode_block(address);
        if (block.has_value()) {
          EXPECT_EQ(*block, *intact->decode_block(address)) << end << " bytes";
          ++unharmed;
        } else {
          EXPECT_EQ(block.error().code, ErrorCode::kTileOverrun) << end << " bytes";
          ++failed;
        }
      }
    }
    EXPECT_GT(failed, 0u) << end << " of " << only.record_bytes << " bytes";
    const auto fast = decoder->decode_plane({0, 1}, Plane::kY);
    ASSERT_FALSE(fast.has_value()) << end << " bytes";
    EXPECT_EQ(fast.error().code, ErrorCode::kTileOverrun) << end << " bytes";
  }
  // A record that ends with its vectors cannot be read in parts.
  EXPECT_EQ(unharmed > 0, GetParam() == 0);
}

// With a threshold of 0 the record ends with values; with 17, more than the noise of a block, it
// ends with vectors.
INSTANTIATE_TEST_SUITE_P(Thresholds, CutRecord, ::testing::Values(0u, 17u));

}  // namespace
}  // namespace hmlfc
