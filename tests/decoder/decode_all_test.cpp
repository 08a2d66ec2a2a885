// All views at once: the same pictures as one view after another, and an error of one of them
// (DEC-1, EXT-5).
#include <cstdint>
#include <map>
#include <mutex>
#include <random>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include <hmlfc/decoder.hpp>

#include "support/streams.hpp"
#include "vectors/field_stream.hpp"

namespace hmlfc {
namespace {

using test::Bytes;

using Views = std::map<std::pair<uint32_t, uint32_t>, RgbImage>;

Result<Views> decode_all(const Decoder& decoder, int stop_level, int threads) {
  Views views;
  std::mutex mutex;
  const auto done = decoder.decode_all(
      [&](ViewPos view, RgbImage&& image) {
        const std::scoped_lock lock(mutex);
        EXPECT_FALSE(views.contains({view.row, view.col})) << "delivered twice";
        views[{view.row, view.col}] = std::move(image);
      },
      {stop_level, threads});
  if (!done) return tl::unexpected(done.error());
  return views;
}

/// Whether every view decodes; then decode_all delivers just these.
bool check(const Decoder& decoder, int stop_level) {
  const StreamHeader& header = decoder.header();
  Views expected;
  std::map<std::string, int> errors;
  for (uint32_t row = 0; row < header.rows; ++row) {
    for (uint32_t col = 0; col < header.cols; ++col) {
      auto view = decoder.decode_view({row, col}, stop_level);
      if (view) {
        expected[{row, col}] = std::move(*view);
      } else {
        ++errors[to_string(view.error())];
      }
    }
  }
  const auto all = decode_all(decoder, stop_level, 1 + stop_level);
  EXPECT_EQ(all.has_value(), errors.empty());
  if (!all) {
    EXPECT_TRUE(errors.contains(to_string(all.error()))) << to_string(all.error());
    return false;
  }
  EXPECT_EQ(all->size(), expected.size());
  for (const auto& [view, image] : *all) {
    EXPECT_EQ(image.samples, expected[view].samples) << view.first << ", " << view.second;
  }
  return true;
}

TEST(DecodeAll, EqualsOneViewAfterAnother) {
  for (uint64_t seed = 0; seed < 60; ++seed) {
    const Bytes file = vectors::random_stream(seed, {});
    const auto decoder = Decoder::open(file);
    ASSERT_TRUE(decoder.has_value());
    for (int level = 0; level <= decoder->header().tree_height; ++level) {
      EXPECT_TRUE(check(*decoder, level)) << "level " << level;
    }
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
}

TEST(DecodeAll, OfDamagedStreams) {
  std::mt19937 random(2);
  int failed = 0;
  int decoded = 0;
  for (uint64_t seed = 0; seed < 120; ++seed) {
    Bytes file = vectors::random_stream(seed, {.main = false});
    const OpenOptions options{.check_sections = false};
    const StreamHeader header = Decoder::open(file)->header();
    const SectionEntry& tiles = header.sections[3];
    if (tiles.size > 0) file[tiles.offset + random() % tiles.size] ^= 0x10;
    if (seed % 3 == 0) file[header.sections[0].offset + 12] ^= 1;
    const auto decoder = Decoder::open(file, options);
    ASSERT_TRUE(decoder.has_value());
    ++(check(*decoder, 0) ? decoded : failed);
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
  EXPECT_GT(failed, 20);
  EXPECT_GT(decoded, 20);
}

// Only levels that are not keyed have residuals to hold: the reference images of the others are key
// images, which have none (EXT-4, EXT-5).
TEST(DecodeAll, ReferencesOfKeyedLevelsAreNotLoaded) {
  StreamHeader header = test::some_header(1);
  header.profile = Profile::kExtended;
  header.feature_flags = feature_bit(Feature::kLevelKeys);
  header.rows = header.cols = 4;
  header.cluster_rows = header.cluster_cols = 2;
  header.levels = {{2, 2, 1}, {2, 2, 0}};
  for (const uint8_t keyed : {uint8_t{1}, uint8_t{0}}) {
    header.levels[0].key_references = keyed;
    const Bytes file = test::drawn_stream(header, 4);
    const auto decoder = Decoder::open(file);
    ASSERT_TRUE(decoder->load_references(1).has_value());
    EXPECT_EQ(decoder->reference_bytes() == 0, keyed == 1) << decoder->reference_bytes();
  }
}

}  // namespace
}  // namespace hmlfc
