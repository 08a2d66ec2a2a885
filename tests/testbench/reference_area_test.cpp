// The reference area against the decoder: every sample is unpacked from its place and compared.
#include "oracle/reference_area.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>

#include "arithmetic/rounding.hpp"
#include "bits/bit_string.hpp"
#include "decoder/golden/block_walk.hpp"
#include "oracle/golden_stream.hpp"
#include "stimulus/random_stream.hpp"
#include "systemc/suite.hpp"
#include "testbench/test_bench.hpp"

namespace hmlfc::tb {
namespace {

struct Counts {
  uint64_t samples = 0;
  uint64_t poisoned = 0;
};

// Reads an area as the text of docs/decode_unit.md says: strips left to right, top to bottom.
class AreaCheck {
 public:
  AreaCheck(const GoldenStream& stream, const ReferenceArea& area, Counts& counts)
      : stream_(stream), area_(area), counts_(counts) {}

  void check() {
    uint64_t offset = 0;
    for (int l = stream_.geometry().top(); l >= 0; --l) {
      const LevelShape& level = stream_.geometry().level(l);
      const bool read = level.keyed || level.ref_rows > 1 || level.ref_cols > 1;
      for (uint32_t row = 0; row < level.group_rows(); ++row) {
        for (uint32_t col = 0; col < level.group_cols(); ++col) {
          for (const Plane plane : kPlanes) {
            const ImagePos image = stream_.geometry().reference_of_group(l, {row, col});
            offset = check_plane(offset, l, image, plane, read);
          }
        }
      }
    }
    EXPECT_EQ(offset, area_.bytes.size());
  }

 private:
  uint64_t check_plane(uint64_t offset, int level, ImagePos image, Plane plane, bool read) {
    const PlaneShape& shape = stream_.geometry().plane(plane);
    const unsigned b = stream_.geometry().block_size();
    const uint32_t per_strip = 64 / (b * b);
    const uint32_t strips = (shape.blocks_x + per_strip - 1) / per_strip;
    for (uint32_t y = 0; read && y < shape.height; ++y) {
      for (uint32_t x = 0; x < shape.width; ++x) {
        const uint32_t block = x / b;
        const uint64_t strip = uint64_t{y / b} * strips + block / per_strip;
        const uint64_t in_strip = block % per_strip * b * b + y % b * b + x % b;
        const auto place = std::span(area_.bytes).subspan(offset + 144 * strip, 144);
        check_sample({level, image.row, image.col, plane, block, y / b}, x, y, place, in_strip);
      }
    }
    return offset + uint64_t{strips} * shape.blocks_y * 144;
  }

  void check_sample(const BlockSite& site, uint32_t x, uint32_t y, std::span<const uint8_t> place,
                    uint64_t index) {
    const BitString strip(place);
    const unsigned width = strip.field(0, 4);
    const bool raw = width == 15;
    const unsigned bits = raw ? 16 : width;
    const uint32_t field = strip.field(20 + index * bits, bits);
    const int32_t value = raw ? sign_extend(field, 16)
                              : sign_extend(strip.field(4, 16), 16) + static_cast<int32_t>(field);
    const Result<int32_t> expected = reference(site, x, y);
    ++counts_.samples;
    if (expected) {
      ASSERT_EQ(value, *expected) << to_string(site) << " x " << x << " y " << y;
    } else {
      ++counts_.poisoned;
      ASSERT_TRUE(raw);
      ASSERT_EQ(value, static_cast<int32_t>(expected.error().code) - 32768);
    }
  }

  // On demand, not from the sparse planes that the area is built from.
  Result<int32_t> reference(const BlockSite& site, uint32_t x, uint32_t y) {
    if (stream_.geometry().level(site.level).keyed) {
      const auto key =
          stream_.keys().plane(site.level, {site.image_row, site.image_col}, site.plane);
      if (!key) return tl::unexpected(key.error());
      return (*key)->at(x, y);
    }
    const auto block = walk_to_block(stream_.view(), Probe{nullptr, nullptr, site});
    if (!block) return tl::unexpected(block.error());
    const unsigned b = stream_.geometry().block_size();
    return block->residual.at(x % b, y % b);
  }

  const GoldenStream& stream_;
  const ReferenceArea& area_;
  Counts& counts_;
};

UnitParameters unit_of(const std::vector<uint8_t>& stream) {
  return {stream[30], 12, 16, 16};  // block_log2
}

void check_stream(const std::vector<uint8_t>& bytes, Counts& counts) {
  const auto stream = GoldenStream::open(bytes, unit_of(bytes));
  ASSERT_TRUE(stream.has_value());
  const GoldenStream& golden = **stream;
  const ReferenceArea area =
      build_reference_area(golden.view(), golden.keys(), golden.fast_references());
  AreaCheck(golden, area, counts).check();
}

TEST(ReferenceArea, HoldsTheDecodersSamples) {
  Counts counts;
  for (uint32_t seed = 0; seed < 24; ++seed)
    check_stream(suite_stream(seed, 2u << seed % 3), counts);
  EXPECT_GT(counts.samples, 100'000u);
  EXPECT_EQ(counts.poisoned, 0u);
}

TEST(ReferenceArea, PoisonsWhatDoesNotDecode) {
  Counts counts;
  for (uint32_t seed = 0; seed < 24; ++seed) {
    auto bytes = suite_stream(seed, 2u << seed % 3);
    corrupt(bytes, seed % 3 == 0 ? Damage::kKeyImages : Damage::kIndexAndTiles, seed);
    check_stream(bytes, counts);
  }
  EXPECT_GT(counts.poisoned, 1000u);
}

TEST(ReferenceArea, StripsOfAllWidthsUnpackToWhatWasPacked) {
  test::Random random(1);
  for (unsigned bits = 0; bits <= 16; ++bits) {
    for (int round = 0; round < 50; ++round) {
      const int32_t span = 1 << bits;
      const int32_t base =
          static_cast<int32_t>(random() % (65536u - static_cast<uint32_t>(span) + 1));
      StripSamples samples{};
      for (int32_t& sample : samples) {
        sample = base - 32768 + static_cast<int32_t>(random() % static_cast<uint32_t>(span));
      }
      const auto place = pack_strip(samples);
      ASSERT_EQ(unpack_strip(place), samples) << bits << " bits";
    }
  }
}

TEST(ReferenceArea, TheExampleOfAFlatStrip) {
  StripSamples samples{};
  samples.fill(7);
  const auto place = pack_strip(samples);
  EXPECT_EQ(place[0], 0x70);
  EXPECT_TRUE(std::all_of(place.begin() + 1, place.end(), [](uint8_t byte) { return byte == 0; }));
}

}  // namespace
}  // namespace hmlfc::tb
