// Section RIG: its entry among the others, and streams that get one (FIL-1, RIG-1). The errors of
// its entry are vectors.
#include <hmlfc/rig.hpp>

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include <hmlfc/decoder.hpp>

#include "bits/little_endian.hpp"
#include "support/streams.hpp"
#include "syntax/header.hpp"

namespace hmlfc {
namespace {

using test::Bytes;

constexpr size_t kAtRig = 56;  // of its section entry, with three levels: 44 + 4 * 3

StreamHeader with_flag() {
  StreamHeader header = test::some_header(2);
  header.profile = Profile::kExtended;
  header.feature_flags = feature_bit(Feature::kCameraRig);
  return header;
}

Bytes rig_file() {
  return test::file_of(with_flag(), {Bytes(5, 1), Bytes(16), Bytes(), Bytes(3)}, Bytes(7, 9));
}

// 180 bytes of header, then RIG of 7, TOP of 5, ROOT of 16, TILE of 3.
TEST(Rig, SpelledOut) {
  const Bytes file = rig_file();
  ASSERT_EQ(file.size(), 180u + 7 + 5 + 16 + 3);
  EXPECT_EQ(load_le<uint16_t>(file, 10), 180u);
  EXPECT_EQ(load_le<uint32_t>(file, kAtRig), 5u);
  EXPECT_EQ(load_le<uint64_t>(file, kAtRig + 8), 180u);
  EXPECT_EQ(load_le<uint64_t>(file, kAtRig + 16), 7u);
  EXPECT_EQ(load_le<uint32_t>(file, kAtRig + 24), 1u);
  EXPECT_EQ(load_le<uint64_t>(file, kAtRig + 32), 187u);
  const auto header = parse_header(file);
  ASSERT_TRUE(header) << to_string(header.error());
  EXPECT_EQ(header->rig.offset, 180u);
  const auto rig = rig_of(file, *header);
  EXPECT_EQ(Bytes(rig.begin(), rig.end()), Bytes(7, 9));
}

// The samples of a stream do not depend on its rig, nor on whether it has one; a rig is replaced.
TEST(Rig, IsAddedAndReplaced) {
  const StreamHeader header = test::row_of_views(0);
  const Bytes plain = test::drawn_stream(header, 1);
  const Bytes first{'{', '}'};
  const Bytes second(100, 0xFF);
  const Bytes added = with_rig(plain, first).value();
  EXPECT_EQ(added.size(), plain.size() + 24 + first.size());
  EXPECT_EQ(with_rig(with_rig(plain, second).value(), first).value(), added);
  EXPECT_EQ(with_rig(added, {}).value().size(), plain.size() + 24);
  for (const Bytes& file : {added, with_rig(added, second).value()}) {
    const auto decoder = Decoder::open(file);
    ASSERT_TRUE(decoder) << to_string(decoder.error());
    EXPECT_EQ(decoder->statistics()->sections.total(), file.size());
    EXPECT_EQ(decoder->statistics()->sections.other, file.size() - plain.size() - 24);
    for (uint32_t col = 0; col < header.cols; ++col) {
      const auto view = decoder->decode_view({0, col});
      const auto expected = Decoder::open(plain)->decode_view({0, col});
      ASSERT_TRUE(view);
      EXPECT_TRUE(std::ranges::equal(view->samples, expected->samples));
    }
  }
}

TEST(Rig, NoneInProfileMain) {
  const auto file = test::file_of(test::some_header(0), {});
  EXPECT_EQ(with_rig(file, {}).error().code, ErrorCode::kBadFeature);
  EXPECT_TRUE(rig_of(file, parse_header(file).value()).empty());
}

TEST(Rig, ChecksumOfItsOwn) {
  const Bytes plain = test::drawn_stream(test::row_of_views(0), 1);
  Bytes file = with_rig(plain, Bytes(3, 7)).value();
  const uint64_t at = parse_header(file)->rig.offset;
  file[at + 2] ^= 1;
  const auto decoder = Decoder::open(file);
  ASSERT_FALSE(decoder);
  EXPECT_EQ(to_string(decoder.error()),
            "bad_section_crc in RIG at byte " + std::to_string(at) + ": a section is damaged");
  EXPECT_TRUE(Decoder::open(file, {.check_sections = false}));
}

}  // namespace
}  // namespace hmlfc
