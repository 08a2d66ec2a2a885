// Opening a stream: section CRCs, sizes, limits (FIL-6, FIL-7, IDX-4, IDX-5, KEY-1).
#include "decoder/open_stream.hpp"

#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "support/streams.hpp"

namespace hmlfc {
namespace {

using test::Bytes;

constexpr size_t kSectionTable = 44 + 4 * 2;  // tree_height 1

StreamHeader small_header() {
  StreamHeader header = test::some_header(1);
  header.width = 33;
  header.height = 20;
  return header;
}

Bytes good_file() { return test::drawn_stream(small_header(), 1); }

uint64_t section_field(const Bytes& file, size_t section, size_t at) {
  uint64_t value = 0;
  for (size_t i = 8; i-- > 0;) value = 256 * value + file[kSectionTable + 24 * section + at + i];
  return value;
}

std::string outcome(const Bytes& file, const OpenOptions& options = {}) {
  const auto opened = open_stream(file, options);
  return opened ? "ok" : to_string(opened.error());
}

TEST(OpenStream, WithoutFault) {
  EXPECT_EQ(outcome(good_file()), "ok");
  const OpenOptions options{.check_sections = false};
  EXPECT_EQ(outcome(good_file(), options), "ok");
}

// A flipped bit of the last byte of each section: nothing but its CRC can tell.
TEST(OpenStream, SectionCrc) {
  const std::string names[] = {"TOP", "ROOT", "GROUP", "TILE"};
  for (size_t section = 0; section < 4; ++section) {
    Bytes file = good_file();
    const uint64_t offset = section_field(file, section, 8);
    const uint64_t size = section_field(file, section, 16);
    ASSERT_GT(size, 0u);
    file[offset + size - 1] ^= 1;
    const std::string expected = "bad_section_crc in " + names[section] + " at byte " +
                                 std::to_string(offset) + ": a section is damaged";
    EXPECT_EQ(outcome(file), expected);
    const OpenOptions options{.check_sections = false};
    EXPECT_EQ(outcome(file, options), "ok");
  }
}

TEST(OpenStream, SectionSizes) {
  const StreamHeader header = small_header();
  const test::StreamParts parts(header);
  const test::SectionBytes index{parts.top, Bytes(16 * parts.geometry.root_entry_count()), {}, {}};
  const auto starts_with = [&](test::SectionBytes sections, const std::string& start) {
    const std::string found = outcome(test::file_of(header, sections));
    EXPECT_EQ(found.substr(0, start.size()), start);
  };
  test::SectionBytes sections = index;
  sections[0] = {};
  starts_with(sections, "bad_section_size in TOP");
  sections = index;
  sections[1].push_back(0);
  starts_with(sections, "bad_section_size in ROOT");
  sections = index;
  sections[1].pop_back();
  starts_with(sections, "bad_section_size in ROOT");
  sections = index;
  sections[2] = Bytes(15);
  starts_with(sections, "bad_section_size in GROUP");
}

TEST(OpenStream, LimitOfPlaneSamples) {
  OpenOptions options;
  options.limits.max_plane_samples = 33 * 20;
  EXPECT_EQ(outcome(good_file(), options), "ok");
  options.limits.max_plane_samples = 33 * 20 - 1;
  EXPECT_EQ(outcome(good_file(), options).substr(0, 24), "limit_exceeded in header");
}

}  // namespace
}  // namespace hmlfc
