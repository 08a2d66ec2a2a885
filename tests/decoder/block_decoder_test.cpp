// Every sample of small streams put together by hand, on all decoding paths (DEC-1 to DEC-6, COL-2,
// COL-3).
#include <algorithm>
#include <cstdint>
#include <random>

#include <gtest/gtest.h>

#include <hmlfc/decoder.hpp>

#include "decoder/naive_stream.hpp"

namespace hmlfc {
namespace {

using test::Bytes;
using test::NaiveImage;
using test::NaiveSize;
using test::NaiveStream;

NaiveImage ancestor(const NaiveStream& stream, ViewPos view, int level) {
  NaiveImage image{0, view.row, view.col};
  while (image.level < level) image = stream.tree().parent(image);
  return image;
}

void check_block(const NaiveStream& stream, const Decoder& decoder, const BlockAddress& at,
                 int level) {
  const uint32_t side = stream.header().block_size();
  const NaiveSize size = stream.tree().plane_size(at.plane);
  const NaiveImage image = ancestor(stream, at.view, level);
  for (const ReferenceMode mode : {ReferenceMode::kOnDemand, ReferenceMode::kSparse}) {
    const auto block = decoder.decode_block(at, {.stop_level = level, .references = mode});
    ASSERT_TRUE(block.has_value()) << to_string(block.error());
    ASSERT_EQ(block->size(), size_t{side} * side);
    for (uint32_t j = 0; j < side && at.by * side + j < size.height; ++j) {
      for (uint32_t i = 0; i < side && at.bx * side + i < size.width; ++i) {
        ASSERT_EQ((*block)[j * side + i],
                  stream.sample(image, at.plane, at.bx * side + i, at.by * side + j))
            << "level " << level << ", block " << at.bx << ", " << at.by << ", sample " << i << ", "
            << j;
      }
    }
  }
}

void check_plane(const NaiveStream& stream, const Decoder& decoder, ViewPos view, Plane plane,
                 int level) {
  const NaiveSize size = stream.tree().plane_size(plane);
  const NaiveImage image = ancestor(stream, view, level);
  const auto samples = decoder.decode_plane(view, plane, level);
  ASSERT_TRUE(samples.has_value()) << to_string(samples.error());
  ASSERT_EQ(samples->size(), size_t{size.width} * size.height);
  for (uint32_t y = 0; y < size.height; ++y) {
    for (uint32_t x = 0; x < size.width; ++x) {
      ASSERT_EQ((*samples)[size_t{y} * size.width + x], stream.sample(image, plane, x, y))
          << plane_name(plane) << " at " << x << ", " << y << " of level " << level;
    }
  }
}

Rect draw_rect(std::mt19937& random, uint32_t width, uint32_t height) {
  const auto below = [&](uint32_t end) { return static_cast<uint32_t>(random() % end); };
  const uint32_t x = below(width);
  const uint32_t y = below(height);
  return {x, y, 1 + below(width - x), 1 + below(height - y)};
}

void check_rect(std::mt19937& random, const NaiveStream& stream, const Decoder& decoder,
                ViewPos view, Plane plane, int level) {
  const NaiveSize size = stream.tree().plane_size(plane);
  const NaiveImage image = ancestor(stream, view, level);
  const Rect rect = draw_rect(random, size.width, size.height);
  const auto samples = decoder.decode_rect(view, plane, rect, level);
  ASSERT_TRUE(samples.has_value()) << to_string(samples.error());
  ASSERT_EQ(samples->size(), size_t{rect.width} * rect.height);
  for (uint32_t i = 0; i < rect.width * rect.height; ++i) {
    const uint32_t x = rect.x + i % rect.width;
    const uint32_t y = rect.y + i / rect.width;
    ASSERT_EQ((*samples)[i], stream.sample(image, plane, x, y)) << x << ", " << y;
  }
}

// One level after another from the top: each rectangle of whole blocks from that of the level
// above.
void check_refined(std::mt19937& random, const NaiveStream& stream, const Decoder& decoder,
                   ViewPos view, Plane plane) {
  const NaiveSize size = stream.tree().plane_size(plane);
  const uint32_t side = stream.header().block_size();
  Rect rect = draw_rect(random, size.width, size.height);
  const uint32_t right = std::min((rect.x + rect.width + side - 1) / side * side, size.width);
  const uint32_t bottom = std::min((rect.y + rect.height + side - 1) / side * side, size.height);
  rect.x -= rect.x % side;
  rect.y -= rect.y % side;
  rect.width = right - rect.x;
  rect.height = bottom - rect.y;
  const int top = stream.header().tree_height;
  auto samples = decoder.decode_rect(view, plane, rect, top);
  ASSERT_TRUE(samples.has_value()) << to_string(samples.error());
  for (int level = top - 1; level >= 0; --level) {
    const auto refined = decoder.refine_rect(view, plane, rect, level, *samples);
    ASSERT_TRUE(refined.has_value()) << to_string(refined.error());
    const auto whole = decoder.decode_rect(view, plane, rect, level);
    ASSERT_TRUE(whole.has_value()) << to_string(whole.error());
    ASSERT_EQ(*samples, *whole) << plane_name(plane) << " of level " << level;
  }
}

int64_t clamped(int64_t value, int depth) {
  return std::max<int64_t>(0, std::min<int64_t>(value, (1 << depth) - 1));
}

// COL-2 of one pixel, whose Co and Cg stand where COL-3 says.
void check_rgb(std::mt19937& random, const NaiveStream& stream, const Decoder& decoder,
               ViewPos view) {
  const StreamHeader& header = stream.header();
  const Rect rect = draw_rect(random, header.width, header.height);
  const auto picture = decoder.decode_rgb(view, rect);
  ASSERT_TRUE(picture.has_value()) << to_string(picture.error());
  const uint32_t half = header.chroma_format == ChromaFormat::k420 ? 2 : 1;
  for (uint32_t i = 0; i < rect.width * rect.height; ++i) {
    const uint32_t x = rect.x + i % rect.width;
    const uint32_t y = rect.y + i / rect.width;
    const NaiveImage image{0, view.row, view.col};
    const int64_t co = stream.sample(image, Plane::kCo, x / half, y / half);
    const int64_t cg = stream.sample(image, Plane::kCg, x / half, y / half);
    const int64_t t = stream.sample(image, Plane::kY, x, y) - (cg >> 1);
    const int64_t b = t - (co >> 1);
    const int64_t rgb[] = {b + co, cg + t, b};
    for (size_t c = 0; c < 3; ++c) {
      ASSERT_EQ(picture->samples[3 * i + c], clamped(rgb[c], header.depth)) << x << ", " << y;
    }
  }
}

// One plane, a rectangle, a picture and some blocks of each view.
void check_stream(std::mt19937& random, const NaiveStream& stream) {
  const Bytes file = stream.file();
  const auto decoder = Decoder::open(file);
  ASSERT_TRUE(decoder.has_value()) << to_string(decoder.error());
  const StreamHeader& header = stream.header();
  for (uint32_t row = 0; row < header.rows; ++row) {
    for (uint32_t col = 0; col < header.cols; ++col) {
      const Plane plane = kPlanes[random() % 3];
      const int level = test::draw(random, 0, header.tree_height);
      ASSERT_NO_FATAL_FAILURE(check_plane(stream, *decoder, {row, col}, plane, level));
      ASSERT_NO_FATAL_FAILURE(check_rect(random, stream, *decoder, {row, col}, plane, level));
      ASSERT_NO_FATAL_FAILURE(check_rgb(random, stream, *decoder, {row, col}));
      ASSERT_NO_FATAL_FAILURE(check_refined(random, stream, *decoder, {row, col}, plane));
      const NaiveSize blocks = stream.tree().plane_blocks(plane);
      for (int i = 0; i < 12; ++i) {
        const BlockAddress at{{row, col},
                              plane,
                              static_cast<uint32_t>(random() % blocks.width),
                              static_cast<uint32_t>(random() % blocks.height)};
        ASSERT_NO_FATAL_FAILURE(check_block(stream, *decoder, at, level));
      }
    }
  }
}

TEST(BlockDecoder, RandomStreams) {
  std::mt19937 random(1);
  for (int round = 0; round < 30; ++round) {
    const StreamHeader header = test::draw_stream_header(random);
    const NaiveStream stream(random, header, 1 + round % 4);
    ASSERT_NO_FATAL_FAILURE(check_stream(random, stream)) << "round " << round;
  }
}

// Every combination of flags that fit together, four streams each.
TEST(BlockDecoder, RandomExtendedStreams) {
  std::mt19937 random(3);
  for (uint32_t flags = 0; flags < 512; ++flags) {
    if ((flags & 2) == 0 && (flags & 60) != 0) continue;
    const StreamHeader header = test::draw_extended_header(random, flags);
    const NaiveStream stream(random, header, static_cast<int>(1 + flags % 4));
    ASSERT_NO_FATAL_FAILURE(check_stream(random, stream)) << "flags " << flags;
  }
}

TEST(BlockDecoder, RefusesToRefineWhatIsNotWholeBlocksOfALevel) {
  StreamHeader header;
  header.rows = header.cols = 2;
  header.width = 18;
  header.height = 13;
  header.tree_height = 1;
  header.levels = {{1, 1}, {1, 1}};
  std::mt19937 random(4);
  const NaiveStream stream(random, header, 1);
  const Bytes file = stream.file();
  const auto decoder = Decoder::open(file);
  ASSERT_TRUE(decoder.has_value()) << to_string(decoder.error());
  ASSERT_EQ(header.block_size(), 4u);
  const auto outcome = [&](const Rect& rect, int level, ViewPos view, size_t more = 0) {
    std::vector<int16_t> samples(size_t{rect.width} * rect.height + more);
    const auto done = decoder->refine_rect(view, Plane::kY, rect, level, samples);
    return done ? ErrorCode::kOk : done.error().code;
  };
  EXPECT_EQ(outcome({4, 8, 14, 5}, 0, {1, 1}), ErrorCode::kOk);
  EXPECT_EQ(outcome({4, 8, 8, 4}, 0, {1, 1}), ErrorCode::kOk);
  for (const Rect& rect : {Rect{5, 8, 3, 4}, Rect{4, 9, 4, 3}, Rect{4, 8, 3, 4}, Rect{4, 8, 4, 3},
                           Rect{4, 8, 16, 4}, Rect{4, 8, 4, 8}, Rect{4, 8, 0, 4}}) {
    EXPECT_EQ(outcome(rect, 0, {0, 0}), ErrorCode::kBadRequest) << rect.x << ", " << rect.y;
  }
  EXPECT_EQ(outcome({4, 8, 4, 4}, 1, {0, 0}), ErrorCode::kBadRequest);
  EXPECT_EQ(outcome({4, 8, 4, 4}, -1, {0, 0}), ErrorCode::kBadRequest);
  EXPECT_EQ(outcome({4, 8, 4, 4}, 0, {0, 2}), ErrorCode::kBadRequest);
  EXPECT_EQ(outcome({4, 8, 4, 4}, 0, {0, 0}, 1), ErrorCode::kBadRequest);
}

// Without tiles, every view is its key image, or 0 in a predictive image of the top level (DEC-6).
TEST(BlockDecoder, StreamsWithoutTiles) {
  std::mt19937 random(2);
  for (int round = 0; round < 5; ++round) {
    const NaiveStream stream(random, test::draw_stream_header(random), 0);
    ASSERT_NO_FATAL_FAILURE(check_stream(random, stream));
  }
}

}  // namespace
}  // namespace hmlfc
