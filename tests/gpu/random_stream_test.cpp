// Random streams of the encoder and streams put together by hand, intact and damaged, at all
// stages.
#include <random>

#include "bits/naive_bits.hpp"
#include "decoder/naive_stream.hpp"
#include "gpu/gpu_test.hpp"
#include "stimulus/conditions.hpp"
#include "stimulus/random_stream.hpp"
#include "syntax/header.hpp"

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
TEST_F(GpuStreams, PutTogetherByHandAreEqual) {
  std::mt19937 random(7);
  CheckCounts total;
  for (uint32_t round = 0; round < 120; ++round) {
    const bool main = round % 4 == 0;
    const StreamHeader header = main ? test::draw_stream_header(random)
                                     : test::draw_extended_header(random, test::draw_flags(random));
    const test::NaiveStream stream(random, header, 4);
    total += expect_equal(device(), stream.file(), {.seed = round});
    ASSERT_FALSE(HasFailure()) << "round " << round;
  }
  EXPECT_GT(total.compared, 60'000u);
}

// A stream some of whose records are random bytes: they end anywhere and hold any field.
test::Bytes with_random_records(std::mt19937& random, const StreamHeader& header) {
  test::NaiveStream stream(random, header, 4);
  for (const auto& tile : stream.tree().tiles()) {
    if (stream.tree().is_key(tile.image) || random() % 2 == 0) continue;
    test::Bytes bytes(1 + random() % (random() % 2 == 0 ? 8 : 200));
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random());
    stream.replace_record(tile, bytes);
  }
  return stream.file();
}

// Every error that a block can have occurs, and is that of the model; but top_sample_range, which
// no damage brings about: the samples would need the right CRC.
TEST_F(GpuStreams, OfRandomRecordsHaveTheErrorsOfTheModel) {
  std::mt19937 random(11);
  CheckCounts total;
  for (uint32_t round = 0; round < 120; ++round) {
    const uint32_t flags = round % 2 == 0 ? 511 : test::draw_flags(random);
    const StreamHeader header = round % 4 == 3 ? test::draw_stream_header(random)
                                               : test::draw_extended_header(random, flags);
    auto bytes = with_random_records(random, header);
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
