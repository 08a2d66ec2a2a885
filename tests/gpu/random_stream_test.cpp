// Random streams of the encoder and streams with random fields, intact and damaged, at all stages.
// Buffers end at guarded pages: nothing outside them is touched.
#include <random>

#include "gpu/gpu_test.hpp"
#include "stimulus/random_stream.hpp"
#include "support/streams.hpp"
#include "syntax/header.hpp"
#include "vectors/field_stream.hpp"

namespace hmlfc::gpu {
namespace {

class GpuStreams : public GpuTest {};

TEST_F(GpuStreams, OfTheEncoderAreEqual) {
  CheckCounts total;
  for (uint32_t seed = 0; seed < 60; ++seed) {
    const auto bytes = tb::suite_stream(seed, 2u << seed % 3);
    total += expect_equal(device(), bytes, {.seed = seed});
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
  EXPECT_GT(total.compared, 30'000u);
  EXPECT_GT(total.levels, 80'000u);
}

TEST_F(GpuStreams, WithDamageHaveTheErrorsOfTheModel) {
  CheckCounts total;
  for (uint32_t seed = 0; seed < 60; ++seed) {
    auto bytes = tb::suite_stream(seed, 2u << seed % 3);
    const auto damage = seed % 4 == 0 ? tb::Damage::kKeyImages : tb::Damage::kIndexAndTiles;
    tb::corrupt(bytes, damage, seed);
    total += expect_equal(device(), bytes, {.seed = seed});
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
  EXPECT_GT(total.compared, 30'000u);
  EXPECT_GT(total.failed(), 4'000u);
}

// Every tool of profile extended, also those that the encoder does not use.
TEST_F(GpuStreams, OfRandomFieldsAreEqual) {
  CheckCounts total;
  for (uint32_t seed = 0; seed < 120; ++seed) {
    total += expect_equal(device(), vectors::random_stream(seed, {}), {.seed = seed});
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
  EXPECT_GT(total.compared, 60'000u);
}

// A stream half of whose records are random bytes: they end anywhere and hold any field.
test::Bytes with_random_records(std::mt19937& random, uint64_t seed) {
  test::StreamParts parts(vectors::random_stream(seed, {}));
  for (test::Bytes& record : parts.records) {
    if (record.empty() || random() % 2 == 0) continue;
    record.resize(1 + random() % (random() % 2 == 0 ? 8 : 200));
    for (uint8_t& byte : record) byte = static_cast<uint8_t>(random());
  }
  return parts.file();
}

// Every error that a block can have occurs, and is that of the model. Only top_sample_range cannot:
// the samples would need the right CRC.
TEST_F(GpuStreams, OfRandomRecordsHaveTheErrorsOfTheModel) {
  std::mt19937 random(11);
  CheckCounts total;
  for (uint32_t round = 0; round < 120; ++round) {
    auto bytes = with_random_records(random, round);
    if (round % 3 == 0) tb::corrupt(bytes, tb::Damage::kIndexAndTiles, round);
    if (round % 5 == 0) tb::corrupt(bytes, tb::Damage::kKeyImages, round);
    total += expect_equal(device(), bytes, {.seed = round});
    ASSERT_FALSE(HasFailure()) << "round " << round;
  }
  EXPECT_GT(total.failed(), 10'000u);
  for (int code = 0; code < kErrorCodeCount; ++code) {
    const auto error = static_cast<ErrorCode>(code);
    const bool of_a_block = error == ErrorCode::kOk || error == ErrorCode::kBadRequest ||
                            (error >= ErrorCode::kBadTopImage && error <= ErrorCode::kVectorRange &&
                             error != ErrorCode::kTopSampleRange);
    EXPECT_EQ(total.statuses[static_cast<size_t>(code)] != 0, of_a_block) << error_name(error);
  }
}

// Entries, records and offsets that point anywhere: an eighth of the bytes of the index are random.
TEST_F(GpuStreams, OfARandomIndexHaveTheErrorsOfTheModel) {
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
    total += expect_equal(device(), bytes, {.requests = 200, .seed = round});
    ASSERT_FALSE(HasFailure()) << "round " << round;
  }
  EXPECT_GT(total.failed(), 1000u);
}

}  // namespace
}  // namespace hmlfc::gpu
