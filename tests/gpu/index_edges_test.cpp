// Fields of the index at the ends of their intervals and one beyond (IDX-4 to IDX-6): the device
// names what the model names.
#include <bit>

#include "bits/bit_string.hpp"
#include "bits/little_endian.hpp"
#include "gpu/gpu_test.hpp"
#include "stimulus/random_stream.hpp"
#include "support/streams.hpp"
#include "syntax/header.hpp"

namespace hmlfc::gpu {
namespace {

using test::Bytes;

// Bits [bit, bit + count) from byte `at` on (CNV-4).
void store_bits(Bytes& bytes, uint64_t at, uint64_t bit, unsigned count, uint64_t value) {
  for (unsigned i = 0; i < count; ++i) {
    uint8_t& byte = bytes[static_cast<size_t>(at + (bit + i) / 8)];
    const auto mask = static_cast<uint8_t>(1u << (bit + i) % 8);
    byte = static_cast<uint8_t>((value >> i & 1) != 0 ? byte | mask : byte & ~mask);
  }
}

// A stream, and its index by place.
class GpuIndexEdges : public GpuTest {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    if (IsSkipped()) return;
    for (uint32_t seed = 0; records() < 2 || records() > 4; ++seed) {
      ASSERT_LT(seed, 200u);
      bytes_ = tb::suite_stream(seed, 4);
      const auto header = parse_header(bytes_);
      ASSERT_TRUE(header);
      root_ = header->sections[1];
      group_ = header->sections[2];
      tile_ = header->sections[3];
    }
  }

  uint64_t records() const { return group_.size / 16; }
  uint64_t place(uint64_t record) const { return group_.offset + 16 * record + 8; }
  uint64_t data(uint64_t record) const {
    return load_le<uint64_t>(bytes_, place(record)) & ((uint64_t{1} << 48) - 1);
  }
  unsigned offset_bits(uint64_t record) const {
    return bytes_[static_cast<size_t>(place(record) + 6)];
  }
  uint64_t entries(uint64_t record) const {
    return static_cast<uint64_t>(std::popcount(load_le<uint64_t>(bytes_, place(record) - 8)));
  }
  uint64_t table_bytes(uint64_t record) const {
    return (entries(record) * offset_bits(record) + 7) / 8;
  }

  // Compares a stream and counts its statuses.
  void check(const Bytes& damaged) {
    total_ += expect_equal(device(), damaged, {.requests = 300, .seed = round_++, .stages = false});
  }

  uint64_t count(ErrorCode error) const { return total_.statuses[static_cast<size_t>(error)]; }

  Bytes bytes_;
  SectionEntry root_, group_, tile_;
  CheckCounts total_;
  uint64_t round_ = 0;
};

TEST_F(GpuIndexEdges, OfRecordNumbers) {
  for (const uint64_t first : {uint64_t{0}, records() - 1, records(), records() + 1,
                               uint64_t{1} << 32, uint64_t{1} << 63, ~uint64_t{0}}) {
    Bytes damaged = bytes_;
    test::patch(damaged, root_.offset + 8, 8, first);
    check(damaged);
  }
  EXPECT_GT(count(ErrorCode::kBadRootEntry), 0u);
}

TEST_F(GpuIndexEdges, OfOffsetBits) {
  for (uint64_t record = 0; record < records(); ++record) {
    for (const unsigned bits : {0u, 1u, 31u, 32u, 33u, 34u, 64u, 255u}) {
      Bytes damaged = bytes_;
      test::patch(damaged, place(record) + 6, 1, bits);
      check(damaged);
    }
    Bytes damaged = bytes_;
    test::patch(damaged, place(record) + 7, 1, 1);
    check(damaged);
  }
  EXPECT_GT(count(ErrorCode::kBadGroupRecord), 0u);
}

TEST_F(GpuIndexEdges, OfData) {
  for (uint64_t record = 0; record < records(); ++record) {
    const uint64_t fits = tile_.size - table_bytes(record);
    for (const uint64_t at : {fits - 1, fits, fits + 1, tile_.size - 1, tile_.size, tile_.size + 1,
                              uint64_t{1} << 32, (uint64_t{1} << 48) - 1}) {
      Bytes damaged = bytes_;
      test::patch(damaged, place(record), 6, at);
      check(damaged);
    }
  }
  EXPECT_GT(count(ErrorCode::kBadGroupRecord), 0u);
  EXPECT_GT(count(ErrorCode::kBadTileOffset), 0u);
}

// Ends equal to the one before, one less, one more, and at the end of the section.
TEST_F(GpuIndexEdges, OfEnds) {
  for (uint64_t record = 0; record < records(); ++record) {
    const unsigned bits = offset_bits(record);
    const uint64_t table = tile_.offset + data(record);
    const uint64_t rest = tile_.size - data(record) - table_bytes(record);
    for (uint64_t entry = 0; entry < entries(record); entry += 1 + entry / 2) {
      const uint64_t before =
          entry == 0 ? 0 : BitString(bytes_).field(8 * table + (entry - 1) * bits, bits);
      for (const uint64_t end : {before, before - 1, before + 1, rest, rest + 1}) {
        Bytes damaged = bytes_;
        store_bits(damaged, table, entry * bits, bits, end);
        check(damaged);
      }
    }
  }
  EXPECT_GT(count(ErrorCode::kBadTileOffset), 0u);
  EXPECT_GT(count(ErrorCode::kTileOverrun), 0u);
}

}  // namespace
}  // namespace hmlfc::gpu
