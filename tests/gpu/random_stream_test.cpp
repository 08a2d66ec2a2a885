// Random streams of the encoder and streams with random fields, intact and damaged, at all stages.
#include <random>

#include "gpu/gpu_test.hpp"
#include "stimulus/random_stream.hpp"
#include "support/streams.hpp"
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

// Every error that a block can have occurs, and is that of the model; but top_sample_range, which
// no damage brings about: the samples would need the right CRC.
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

}  // namespace
}  // namespace hmlfc::gpu
