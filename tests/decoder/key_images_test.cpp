// The TOP section: its table and every error of a key image (KEY-1 to KEY-4).
#include "decoder/key_images.hpp"

#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <hmlfc/decoder.hpp>

#include "bits/naive_bits.hpp"
#include "bits/naive_crc32c.hpp"
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

  /// Puts another plane in the place of `entry`, with its own CRC.
  void replace(size_t entry, const SamplePlane& plane, SamplePrecision precision) {
    codestreams[entry] = encode_jpeg2000(plane, precision).value();
    crcs[entry] = sample_crc(plane);
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

std::string table_outcome(const Bytes& top) {
  std::string name = "ok";
  with_top(top, [&](const StreamView& stream) {
    const auto checked = check_top_table(stream);
    if (checked) return;
    name = error_name(checked.error().code);
    EXPECT_EQ(checked.error().section, Section::kTop);
  });
  return name;
}

/// What decoding each of the nine planes gives.
std::vector<std::string> plane_outcomes(const Bytes& top) {
  std::vector<std::string> names;
  with_top(top, [&](const StreamView& stream) {
    ASSERT_TRUE(check_top_table(stream).has_value());
    const KeyImages keys(stream);
    for (size_t entry = 0; entry < 9; ++entry) {
      const ImagePos at{0, static_cast<uint32_t>(entry / 3 * 2)};
      const auto plane = keys.plane(0, at, kPlanes[entry % 3]);
      names.emplace_back(plane ? "ok" : error_name(plane.error().code));
    }
  });
  return names;
}

std::vector<std::string> all_ok_but(size_t entry, const std::string& name) {
  std::vector<std::string> names(9, "ok");
  names[entry] = name;
  return names;
}

// CRC-32C of the samples in 16 bits each, row by row (KEY-3).
TEST(KeyImages, SampleCrc) {
  std::vector<SamplePlane> planes = TopSection().planes;
  planes.emplace_back(1, 1).samples[0] = -2;  // bytes FE FF
  for (const SamplePlane& plane : planes) {
    test::NaiveBits bits;
    for (const int16_t sample : plane.samples) bits.put_signed(sample, 16);
    EXPECT_EQ(sample_crc(plane), test::naive_crc32c(bits.bytes()));
  }
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

TEST(KeyImages, TableMustFit) {
  for (size_t length = 0; length < 9 * 16; ++length) {
    Bytes top = TopSection().bytes();
    top.resize(length);
    EXPECT_EQ(table_outcome(top), "bad_section_size") << length;
  }
}

TEST(KeyImages, EntriesMustFollowEachOther) {
  const Bytes intact = TopSection().bytes();
  EXPECT_EQ(table_outcome(intact), "ok");
  for (size_t entry = 0; entry < 9; ++entry) {
    for (const int change : {-1, 1}) {
      Bytes top = intact;
      top[16 * entry] = static_cast<uint8_t>(top[16 * entry] + change);
      EXPECT_EQ(table_outcome(top), "bad_top_entry") << "offset of entry " << entry;
    }
    Bytes top = intact;
    top[16 * entry + 7] = 0x80;
    EXPECT_EQ(table_outcome(top), "bad_top_entry") << "offset of entry " << entry;
    top = intact;
    top[16 * entry + 11] = 0xFF;
    EXPECT_EQ(table_outcome(top), "bad_top_entry") << "size of entry " << entry;
  }
}

// The last entry has no successor: too long is an entry past the section, too short leaves a rest.
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

TEST(KeyImages, LastEntryMustEndTheSection) {
  const Bytes intact = TopSection().bytes();
  Bytes top = intact;
  top[16 * 8 + 8] = static_cast<uint8_t>(top[16 * 8 + 8] + 1);
  EXPECT_EQ(table_outcome(top), "bad_top_entry");
  top = intact;
  top[16 * 8 + 8] = static_cast<uint8_t>(top[16 * 8 + 8] - 1);
  EXPECT_EQ(table_outcome(top), "bad_section_size");
  top = intact;
  top.push_back(0);
  EXPECT_EQ(table_outcome(top), "bad_section_size");
  top = intact;
  top.pop_back();
  EXPECT_EQ(table_outcome(top), "bad_top_entry");
}

TEST(KeyImages, BadTopImage) {
  for (size_t entry = 0; entry < 9; ++entry) {
    TopSection top;
    top.codestreams[entry] = Bytes(40, 0x11);
    EXPECT_EQ(plane_outcomes(top.bytes()), all_ok_but(entry, "bad_top_image"));
    top.codestreams[entry].clear();
    EXPECT_EQ(plane_outcomes(top.bytes()), all_ok_but(entry, "bad_top_image"));
    top.replace(entry, SamplePlane(kWidth + 1, kHeight), precision_of(entry));
    EXPECT_EQ(plane_outcomes(top.bytes()), all_ok_but(entry, "bad_top_image"));
    top.replace(entry, SamplePlane(kWidth, kHeight), precision_of(entry % 3 == 0 ? 1 : 0));
    EXPECT_EQ(plane_outcomes(top.bytes()), all_ok_but(entry, "bad_top_image"));
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

// Packets that do not decode, behind markers that are good (KEY-4).
TEST(KeyImages, BadPackets) {
  for (size_t entry = 0; entry < 9; ++entry) {
    TopSection top;
    Bytes& codestream = top.codestreams[entry];
    const Bytes sod{0xFF, 0x93};
    const Bytes wrong{0xEF, 0xFD, 0xFE, 0xF0};
    const auto at = std::search(codestream.begin(), codestream.end(), sod.begin(), sod.end()) + 2;
    std::copy(wrong.begin(), wrong.end(), at);
    EXPECT_EQ(plane_outcomes(top.bytes()), all_ok_but(entry, "bad_top_crc"));
  }
}

TEST(KeyImages, BadTopCrc) {
  for (size_t entry = 0; entry < 9; ++entry) {
    for (const uint32_t bit : {0u, 31u}) {
      TopSection top;
      top.crcs[entry] ^= uint32_t{1} << bit;
      EXPECT_EQ(plane_outcomes(top.bytes()), all_ok_but(entry, "bad_top_crc"));
    }
  }
}

// Nine signed bits hold -256, which no colour has; the CRC is checked first.
TEST(KeyImages, TopSampleRange) {
  for (size_t entry = 0; entry < 9; ++entry) {
    TopSection top;
    SamplePlane plane = top.planes[entry];
    const bool chroma = entry % 3 != 0;
    plane.samples[7] = chroma ? -255 : 0;
    plane.samples[8] = 255;
    top.replace(entry, plane, precision_of(entry));
    EXPECT_EQ(plane_outcomes(top.bytes()), all_ok_but(entry, "ok"));
    if (!chroma) continue;
    plane.samples[7] = -256;
    top.replace(entry, plane, precision_of(entry));
    EXPECT_EQ(plane_outcomes(top.bytes()), all_ok_but(entry, "top_sample_range"));
    top.crcs[entry] ^= 1;
    EXPECT_EQ(plane_outcomes(top.bytes()), all_ok_but(entry, "bad_top_crc"));
  }
}

}  // namespace
}  // namespace hmlfc
