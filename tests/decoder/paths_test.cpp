// All decoding paths give the same samples and the same errors, on random streams, intact and
// damaged (CNV-7, DEC-1 to DEC-7, FIL-6). What the samples are, the vectors and the
// decoder in Python say.
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <hmlfc/decoder.hpp>

#include "support/streams.hpp"
#include "vectors/field_stream.hpp"

namespace hmlfc {
namespace {

using test::Bytes;
using Samples = std::vector<int16_t>;

template <class T>
void expect_same(const Result<T>& a, const Result<T>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (a) {
    ASSERT_EQ(*a, *b);
  } else {
    ASSERT_EQ(to_string(a.error()), to_string(b.error()));
  }
}

/// A plane put together from single blocks, each decoded on demand and from kept references; or the
/// error of the first block that does not decode.
Result<Samples> plane_of_blocks(const Decoder& decoder, ViewPos view, Plane plane, int level) {
  const PlaneSize size = decoder.plane_size(plane);
  const uint32_t side = decoder.header().block_size();
  Samples samples(size_t{size.width} * size.height);
  std::optional<Error> first;
  for (uint32_t y = 0; y < size.height; y += side) {
    for (uint32_t x = 0; x < size.width; x += side) {
      const BlockAddress at{view, plane, x / side, y / side};
      const auto block = decoder.decode_block(at, {.stop_level = level});
      expect_same(block, decoder.decode_block(
                             at, {.stop_level = level, .references = ReferenceMode::kSparse}));
      if (!block && !first) first = block.error();
      for (uint32_t i = 0; block && i < side * side; ++i) {
        if (x + i % side >= size.width || y + i / side >= size.height) continue;
        samples[size_t{y + i / side} * size.width + x + i % side] =
            static_cast<int16_t>((*block)[i]);
      }
    }
  }
  if (first) return tl::unexpected(*first);
  return samples;
}

Samples part_of(const Samples& samples, uint32_t width, const Rect& rect) {
  Samples part;
  for (uint32_t i = 0; i < rect.width * rect.height; ++i) {
    part.push_back(samples[size_t{rect.y + i / rect.width} * width + rect.x + i % rect.width]);
  }
  return part;
}

Rect draw_rect(std::mt19937& random, uint32_t width, uint32_t height) {
  const auto below = [&](uint32_t end) { return static_cast<uint32_t>(random() % end); };
  const uint32_t x = below(width);
  const uint32_t y = below(height);
  return {x, y, 1 + below(width - x), 1 + below(height - y)};
}

void check_view(std::mt19937& random, const Decoder& decoder, ViewPos view) {
  const Plane plane = kPlanes[random() % 3];
  const int level = test::draw(random, 0, decoder.header().tree_height);
  const PlaneSize size = decoder.plane_size(plane);
  const auto samples = plane_of_blocks(decoder, view, plane, level);
  ASSERT_TRUE(samples.has_value()) << to_string(samples.error());
  ASSERT_EQ(decoder.decode_plane(view, plane, level).value(), *samples);
  const Rect rect = draw_rect(random, size.width, size.height);
  ASSERT_EQ(decoder.decode_rect(view, plane, rect, level).value(),
            part_of(*samples, size.width, rect));
}

TEST(Paths, AgreeOnRandomStreams) {
  std::mt19937 random(1);
  for (uint64_t seed = 0; seed < 300; ++seed) {
    const Bytes file = vectors::random_stream(seed, {.view_side = 60});
    const auto decoder = Decoder::open(file);
    ASSERT_TRUE(decoder.has_value()) << to_string(decoder.error());
    const StreamHeader& header = decoder->header();
    for (uint32_t i = 0; i < header.rows * header.cols; ++i) {
      check_view(random, *decoder, {i / header.cols, i % header.cols});
      ASSERT_FALSE(HasFailure()) << "seed " << seed;
    }
  }
}

// Three flipped bits of groups and records.
void damage(std::mt19937& random, Bytes& file, const StreamHeader& header) {
  for (int flips = 0; flips < 3; ++flips) {
    const SectionEntry& section = header.sections[random() % 8 == 0 ? 2 : 3];
    if (section.size == 0) continue;
    file[section.offset + random() % section.size] ^= static_cast<uint8_t>(1u << random() % 8);
  }
}

// A plane decodes if each of its blocks does; else its error is that of the first that does not.
TEST(Paths, AgreeOnDamagedStreams) {
  std::mt19937 random(2);
  int failed = 0;
  int decoded = 0;
  for (uint64_t seed = 0; seed < 250; ++seed) {
    Bytes file = vectors::random_stream(seed, {.grid_side = 4});
    const OpenOptions options{.check_sections = false};
    const StreamHeader header = Decoder::open(file, options)->header();
    damage(random, file, header);
    const auto decoder = Decoder::open(file, options);
    ASSERT_TRUE(decoder.has_value());
    for (uint32_t i = 0; i < header.rows * header.cols; i += 2) {
      const ViewPos view{i / header.cols, i % header.cols};
      const Plane plane = kPlanes[random() % 3];
      const auto whole = decoder->decode_plane(view, plane);
      expect_same(whole, plane_of_blocks(*decoder, view, plane, 0));
      ASSERT_FALSE(HasFailure()) << "seed " << seed;
      ++(whole ? decoded : failed);
    }
  }
  EXPECT_GT(failed, 90) << "the damage is found";
  EXPECT_GT(decoded, 90) << "and does not spread";
}

}  // namespace
}  // namespace hmlfc
