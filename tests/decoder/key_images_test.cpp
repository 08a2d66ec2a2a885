// The TOP section: the order of its planes, entries that change, the limit of code-blocks (KEY-1,
// KEY-2). The errors of entries and key images are vectors.
#include "decoder/key_images.hpp"

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <hmlfc/decoder.hpp>

#include "decoder/jpeg2000.hpp"
#include "encoder/stream_assembly.hpp"
#include "support/changing_source.hpp"
#include "support/streams.hpp"
#include "syntax/header.hpp"

namespace hmlfc {
namespace {

using test::Bytes;

constexpr uint32_t kWidth = 11;
constexpr uint32_t kHeight = 6;

// Three key images in a row of five: groups of two columns.
StreamHeader three_keys() {
  StreamHeader header;
  header.rows = 1;
  header.cols = 5;
  header.width = kWidth;
  header.height = kHeight;
  header.chroma_format = ChromaFormat::k444;
  header.levels = {{1, 2}};
  return header;
}

SamplePrecision precision_of(size_t entry) {
  return entry % 3 == 0 ? SamplePrecision{8, false} : SamplePrecision{9, true};
}

/// The key samples, codestreams and CRCs of a stream, to be damaged one by one.
struct TopSection {
  std::vector<SamplePlane> planes;
  std::vector<Bytes> codestreams;
  std::vector<uint32_t> crcs;

  TopSection() {
    std::mt19937 random(1);
    for (size_t entry = 0; entry < 9; ++entry) {
      SamplePlane plane(kWidth, kHeight);
      for (int16_t& sample : plane.samples) {
        sample = static_cast<int16_t>(test::draw(random, entry % 3 == 0 ? 0 : -255, 255));
      }
      planes.push_back(plane);
      codestreams.push_back(encode_jpeg2000(plane, precision_of(entry)).value());
      crcs.push_back(sample_crc(plane));
    }
  }

  Bytes bytes() const { return top_section(codestreams, crcs); }
};

/// Opens a stream with this TOP section and calls `use(stream)`.
template <class Use>
void with_top(const Bytes& top, const Use& use) {
  const Bytes file = test::file_of(three_keys(), {top, Bytes(16), {}, {}});
  const auto header = parse_header(file);
  ASSERT_TRUE(header.has_value());
  use(StreamView{file, *header, Geometry(*header)});
}

TEST(KeyImages, PlanesStandInAscendingImageNumbers) {
  const TopSection top;
  with_top(top.bytes(), [&](const StreamView& stream) {
    ASSERT_TRUE(check_top_table(stream).has_value());
    const KeyImages keys(stream);
    for (size_t entry = 0; entry < 9; ++entry) {
      const ImagePos at{0, static_cast<uint32_t>(entry / 3 * 2)};
      const auto plane = keys.plane(0, at, kPlanes[entry % 3]);
      ASSERT_TRUE(plane.has_value());
      EXPECT_EQ((*plane)->samples, top.planes[entry].samples) << entry;
    }
  });
}

// A partial source that gave one table when the stream was opened gives another afterwards.
TEST(KeyImages, EntriesThatChangeAreErrors) {
  const Bytes top = TopSection().bytes();
  const Bytes file = test::file_of(three_keys(), {top, Bytes(16), {}, {}});
  const auto begin = std::search(file.begin(), file.end(), top.begin(), top.end()) - file.begin();
  const uint64_t size = top.size();
  const std::pair<uint64_t, uint32_t> entries[] = {
      {size + 1, 0}, {size, 1}, {UINT64_MAX, 2}, {uint64_t{1} << 46, 0x7fffffff}, {0, UINT32_MAX}};
  for (const auto& [offset, bytes] : entries) {
    test::ChangingSource source(file, 0, 0);
    const auto decoder = Decoder::open(source, {.check_sections = false});
    ASSERT_TRUE(decoder);
    Bytes changed = file;
    for (size_t at = static_cast<size_t>(begin), i = 0; i < 9; ++i, at += kTopEntryBytes) {
      for (size_t k = 0; k < 8; ++k) changed[at + k] = static_cast<uint8_t>(offset >> 8 * k);
      for (size_t k = 0; k < 4; ++k) changed[at + 8 + k] = static_cast<uint8_t>(bytes >> 8 * k);
    }
    source.become(changed);
    const auto block = decoder->decode_block({{0, 0}, Plane::kY, 0, 0});
    ASSERT_FALSE(block);
    EXPECT_EQ(block.error().code, ErrorCode::kBadTopEntry);
    EXPECT_EQ(decoder->decode_view({0, 0}).error().code, ErrorCode::kBadTopEntry);
  }
}

// 11 x 6 samples in code-blocks of 4x4: 3 x 2 without decompositions. With one, the bands of 6 x 3,
// 5 x 3, 6 x 3 and 5 x 3 samples have 2 each; with two, that of 6 x 3 makes four more of one each.
TEST(KeyImages, CodeBlocksAreLimited) {
  TopSection top;
  const uint64_t counts[] = {6, 8, 10};
  for (int n = 0; n < 3; ++n) {
    const CodestreamOptions options{.block_width = 4, .block_height = 4, .decompositions = n};
    top.codestreams[0] = encode_jpeg2000(top.planes[0], precision_of(0), options).value();
    const uint64_t count = counts[n];
    EXPECT_EQ(code_blocks_of(top.codestreams[0], kWidth, kHeight), count);
    with_top(top.bytes(), [&](StreamView stream) {
      stream.max_code_blocks = count;
      EXPECT_TRUE(KeyImages(stream).plane(0, {0, 0}, Plane::kY));
      stream.max_code_blocks = count - 1;
      const auto plane = KeyImages(stream).plane(0, {0, 0}, Plane::kY);
      ASSERT_FALSE(plane);
      EXPECT_EQ(plane.error().code, ErrorCode::kLimitExceeded);
    });
  }
}

}  // namespace
}  // namespace hmlfc
