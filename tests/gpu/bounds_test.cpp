// Nothing outside the buffers is touched: every buffer ends at a page that nobody may touch, no
// feature for robust access is on, and the streams are damaged in every way.
#include <random>

#include "gpu/gpu_test.hpp"
#include "stimulus/random_stream.hpp"
#include "support/streams.hpp"
#include "syntax/header.hpp"

namespace hmlfc::gpu {
namespace {

class GpuBounds : public GpuTest {};

DeviceOptions guarded(uint64_t chunk_bytes) {
  DeviceOptions options;
  options.guard_pages = true;
  options.chunk_bytes = chunk_bytes;
  return options;
}

void check_damaged_streams(Device& device, uint32_t begin, uint32_t end) {
  CheckCounts total;
  for (uint32_t seed = begin; seed < end; ++seed) {
    auto bytes = tb::suite_stream(seed, 2u << seed % 3);
    tb::corrupt(bytes, tb::Damage::kIndexAndTiles, seed);
    total += expect_equal(device, bytes, {.requests = 200, .seed = seed});
    ASSERT_FALSE(testing::Test::HasFailure()) << "seed " << seed;
  }
  EXPECT_GT(total.failed(), 100u);
}

TEST_F(GpuBounds, AreKeptByDamagedStreams) {
  auto device = open(guarded(0));
  ASSERT_TRUE(device);
  check_damaged_streams(*device, 100, 140);
}

TEST_F(GpuBounds, AreKeptByDamagedStreamsInSmallChunks) {
  auto device = open(guarded(4096));
  ASSERT_TRUE(device);
  check_damaged_streams(*device, 140, 152);
}

// The index alone, all of it random: entries, records and offsets point anywhere.
TEST_F(GpuBounds, AreKeptByARandomIndex) {
  auto device = open(guarded(0));
  ASSERT_TRUE(device);
  std::mt19937 random(5);
  CheckCounts total;
  for (uint32_t round = 0; round < 40; ++round) {
    auto bytes = tb::suite_stream(round, 2u << round % 3);
    const auto header = parse_header(bytes);
    ASSERT_TRUE(header);
    const SectionEntry& root = header->sections[1];
    const SectionEntry& tile = header->sections[3];
    const uint64_t last = round % 2 == 0 ? tile.offset : bytes.size();
    for (uint64_t at = root.offset; at < last; ++at) {
      if (random() % 8 == 0) bytes[static_cast<size_t>(at)] = static_cast<uint8_t>(random());
    }
    total += expect_equal(*device, bytes, {.requests = 200, .seed = round});
    ASSERT_FALSE(HasFailure()) << "round " << round;
  }
  EXPECT_GT(total.failed(), 1000u);
}

// A stream of empty tiles whose ROOT says that no group is empty: record numbers 0 to 63 of a GROUP
// section without records.
TEST_F(GpuBounds, AreKeptByGroupsOfAnEmptySection) {
  auto device = open(guarded(0));
  ASSERT_TRUE(device);
  StreamHeader header = test::some_header(0);
  header.rows = header.cols = 6;
  header.width = header.height = 64;
  header.block_log2 = 1;
  header.levels.assign(1, {3, 3, 0});
  auto bytes = test::StreamParts(header).file();
  const auto parsed = parse_header(bytes);
  ASSERT_TRUE(parsed);
  ASSERT_EQ(parsed->sections[2].size, 0u);
  const uint64_t root = parsed->sections[1].offset;
  for (uint64_t i = 0; i < 8; ++i) bytes[static_cast<size_t>(root + i)] = 0xFF;  // the mask
  const CheckCounts counts = expect_equal(*device, bytes, {});
  EXPECT_GT(counts.statuses[static_cast<size_t>(ErrorCode::kBadRootEntry)], 100u);
}

}  // namespace
}  // namespace hmlfc::gpu
