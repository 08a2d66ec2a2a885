// A damaged file is never taken for a whole one.
#include <gtest/gtest.h>

#include <hmlfc/decoder.hpp>
#include <hmlfc/encoder.hpp>

#include "scenes/test_light_fields.hpp"

namespace hmlfc {
namespace {

constexpr LightFieldShape kSmallShape{3, 2, 13, 9, 8};

std::vector<uint8_t> small_stream(Method method) {
  EncodeParams params;
  params.profile = Profile::kMain;
  params.method = method;
  params.tree_height = 1;
  params.window = 3;
  params.ref_rows = 2;
  params.ref_cols = 2;
  params.main.threshold_ref = 20;
  params.main.threshold_pred = 30;
  const auto encoded = encode(test::textured_light_field(kSmallShape, 9, 5), params);
  return encoded ? encoded->bytes : std::vector<uint8_t>{};
}

// All views by the fast path and some blocks by the golden path.
Result<void> decode_everything(std::span<const uint8_t> file) {
  OpenOptions options;
  options.limits.max_plane_samples = 1u << 16;
  const auto decoder = Decoder::open(file, options);
  if (!decoder) return tl::unexpected(decoder.error());
  const StreamHeader& header = decoder->header();
  if (uint64_t{header.rows} * header.cols > 64) {
    return fail(ErrorCode::kLimitExceeded, Section::kHeader, 16);
  }
  for (uint32_t row = 0; row < header.rows; ++row) {
    for (uint32_t col = 0; col < header.cols; ++col) {
      const auto view = decoder->decode_view({row, col});
      const auto golden = decoder->decode_block({{row, col}, Plane::kY, 1, 1});
      if (!view) return tl::unexpected(view.error());
      if (!golden) return tl::unexpected(golden.error());
    }
  }
  return {};
}

class Corruption : public ::testing::TestWithParam<Method> {};

// Every byte of a file is under a CRC or compared with one.
TEST_P(Corruption, EveryBitFlipIsFound) {
  const std::vector<uint8_t> good = small_stream(GetParam());
  ASSERT_TRUE(decode_everything(good).has_value());
  for (size_t bit = 0; bit < good.size() * 8; ++bit) {
    std::vector<uint8_t> bad = good;
    bad[bit / 8] = static_cast<uint8_t>(bad[bit / 8] ^ (1u << (bit % 8)));
    EXPECT_FALSE(decode_everything(bad).has_value()) << "bit " << bit;
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, Corruption,
                         ::testing::Values(Method::kHmlfc, Method::kRlfc, Method::kMc));

}  // namespace
}  // namespace hmlfc
