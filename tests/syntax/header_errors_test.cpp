// Faulty headers: the named error at the place of the field, in the order of FIL-4.
#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "support/streams.hpp"
#include "syntax/header.hpp"

namespace hmlfc {
namespace {

using test::Bytes;

constexpr int kHeight = 2;
constexpr size_t kHeaderBytes = 156;  // 44 + 4 * 3 + 96 + 4
constexpr size_t kSectionTable = 56;

Bytes good_file() {
  return test::file_of(test::some_header(kHeight), {Bytes(5, 1), Bytes(16), Bytes(), Bytes(3)});
}

/// A value put in a field, and what FIL-4 makes of it.
struct Fault {
  std::string name;
  size_t offset;
  unsigned size;
  uint64_t value;
  ErrorCode code;
  size_t first;  ///< the error's byte offset lies in [first, last]
  size_t last;
  bool sealed = true;  ///< header_crc fits the faulty bytes
};

Fault field(const std::string& name, size_t offset, unsigned size, uint64_t value) {
  return {name, offset, size, value, ErrorCode::kBadHeaderField, offset, offset + size - 1};
}

void add_fixed_fields(std::vector<Fault>& faults) {
  const auto add = [&](const char* name, size_t offset, unsigned size,
                       std::initializer_list<uint64_t> values) {
    for (const uint64_t value : values) faults.push_back(field(name, offset, size, value));
  };
  add("rows", 16, 2, {0, 4097, 65535});
  add("cols", 18, 2, {0, 4097, 65535});
  add("width", 20, 4, {0, 65537, 0xFFFFFFFF});
  add("height", 24, 4, {0, 65537, 0x80000000});
  add("depth", 28, 1, {0, 7, 13, 255});
  add("chroma_format", 29, 1, {2, 255});
  add("block_log2", 30, 1, {0, 4, 255});
  add("window", 31, 1, {128, 255});
  add("cluster_rows", 32, 1, {0});
  add("cluster_cols", 33, 1, {0});
  // 1 x 1 clusters: a rule of cluster_cols that needs tree_height to be known.
  Fault one_by_one = field("cluster of one image", 32, 2, 0x0101);
  one_by_one.first = 33;
  one_by_one.last = 34;
  faults.push_back(one_by_one);
  add("tree_height", 34, 1, {16, 255});
  for (size_t i = 0; i < 9; ++i) {
    Fault reserved = field("reserved", 35 + i, 1, 1);
    reserved.first = 35;
    faults.push_back(reserved);
  }
}

void add_level_fields(std::vector<Fault>& faults) {
  for (size_t level = 0; level <= kHeight; ++level) {
    const size_t at = 44 + 4 * level;
    for (Fault fault :
         {field("ref_rows", at, 1, 0), field("ref_cols", at + 1, 1, 0),
          field("level reserved", at + 2, 1, 1), field("level reserved", at + 3, 1, 128)}) {
      fault.first = at;
      faults.push_back(fault);
    }
  }
}

void add_sections(std::vector<Fault>& faults) {
  for (size_t i = 0; i < 4; ++i) {
    const size_t at = kSectionTable + 24 * i;
    const auto add = [&](const char* name, size_t offset, unsigned size, uint64_t value) {
      faults.push_back({name, offset, size, value, ErrorCode::kBadSectionTable, at, at + 23});
    };
    add("section type", at, 4, 0);
    add("section type", at, 4, i + 2);
    add("section type", at, 4, (uint64_t{1} << 31) + i + 1);
    add("section offset", at + 8, 8, 0);
    add("section offset", at + 8, 8, kHeaderBytes + 100);
    add("section offset", at + 8, 8, ~uint64_t{0});
  }
}

/// Every fault, in the order in which FIL-4 checks.
std::vector<Fault> all_faults() {
  std::vector<Fault> faults;
  for (size_t i = 0; i < 8; ++i) {
    faults.push_back({"magic", i, 1, 0x20, ErrorCode::kBadMagic, 0, 7});
  }
  for (const uint64_t version : {0u, 2u, 255u}) {
    faults.push_back({"version", 8, 1, version, ErrorCode::kBadVersion, 8, 8});
  }
  for (const uint64_t size : {0u, 15u, 147u}) {
    faults.push_back({"header_bytes too few", 10, 2, size, ErrorCode::kTruncated, 10, 11});
  }
  const size_t end = good_file().size();
  for (const uint64_t size : {uint64_t{end + 1}, uint64_t{65535}}) {
    faults.push_back({"header_bytes past the file", 10, 2, size, ErrorCode::kTruncated, end, end});
  }
  faults.push_back({"header_crc", kHeaderBytes - 4, 4, 0xDEADBEEF, ErrorCode::kBadHeaderCrc,
                    kHeaderBytes - 4, kHeaderBytes - 1, false});
  for (const uint64_t profile : {2u, 255u}) {
    faults.push_back({"profile", 9, 1, profile, ErrorCode::kBadProfile, 9, 9});
  }
  for (const uint64_t flags : {uint64_t{1}, uint64_t{0x80000000}}) {
    faults.push_back({"feature_flags", 12, 4, flags, ErrorCode::kBadFeature, 12, 15});
  }
  add_fixed_fields(faults);
  faults.push_back(field("header_bytes of another height", 10, 2, kHeaderBytes + 4));
  add_level_fields(faults);
  add_sections(faults);
  faults.push_back(
      {"TILE past the file", kSectionTable + 3 * 24 + 16, 8, 4, ErrorCode::kTruncated, end, end});
  faults.push_back({"TILE past 2^64", kSectionTable + 3 * 24 + 16, 8, ~uint64_t{0},
                    ErrorCode::kTruncated, end, end});
  faults.push_back({"bytes behind TILE", kSectionTable + 3 * 24 + 16, 8, 2,
                    ErrorCode::kTrailingBytes, end - 1, end - 1});
  return faults;
}

// The error of `file`, whose byte offset lies in [first, last].
void expect_error(std::span<const uint8_t> file, std::string_view name, uint64_t first,
                  uint64_t last, const std::string& what = "") {
  const auto parsed = parse_header(file);
  ASSERT_FALSE(parsed.has_value()) << what;
  EXPECT_EQ(error_name(parsed.error().code), name) << what;
  EXPECT_GE(parsed.error().offset, first) << what;
  EXPECT_LE(parsed.error().offset, last) << what;
}

void expect_error(const Bytes& file, const Fault& fault, const std::string& what) {
  expect_error(file, error_name(fault.code), fault.first, fault.last, what);
}

std::string name_of(const Fault& fault) {
  return fault.name + " = " + std::to_string(fault.value) + " at " + std::to_string(fault.offset);
}

TEST(HeaderErrors, TheFileWithoutFaultIsValid) {
  EXPECT_EQ(good_file().size(), kHeaderBytes + 24);
  EXPECT_TRUE(parse_header(good_file()).has_value());
}

TEST(HeaderErrors, EachFaultAlone) {
  for (const Fault& fault : all_faults()) {
    Bytes file = good_file();
    test::patch(file, fault.offset, fault.size, fault.value);
    if (fault.sealed) test::seal(file);
    expect_error(file, fault, name_of(fault));
  }
}

/// Whether both fit in one file: other bytes, and header_bytes does not move a wrong header_crc.
bool are_independent(const Fault& a, const Fault& b) {
  const bool overlap = a.offset < b.offset + b.size && b.offset < a.offset + a.size;
  const bool moved = (!a.sealed && b.offset == 10) || (!b.sealed && a.offset == 10);
  return !overlap && !moved;
}

TEST(HeaderErrors, OfTwoFaultsTheFirstOfTheOrderCounts) {
  const std::vector<Fault> faults = all_faults();
  for (size_t i = 0; i < faults.size(); ++i) {
    for (size_t j = i + 1; j < faults.size(); ++j) {
      const Fault& a = faults[i];
      const Fault& b = faults[j];
      if (!are_independent(a, b)) continue;
      Bytes file = good_file();
      test::patch(file, a.offset, a.size, a.value);
      test::patch(file, b.offset, b.size, b.value);
      if (a.sealed && b.sealed) test::seal(file);
      expect_error(file, a, name_of(a) + " and " + name_of(b));
      if (HasFailure()) return;
    }
  }
}

// A size that does not fit moves the place where the next section should begin.
TEST(HeaderErrors, SectionTableIsCheckedBeforeTheEndOfTheFile) {
  for (const uint64_t size : {uint64_t{1000}, uint64_t{1} << 63, ~uint64_t{0}}) {
    Bytes file = good_file();
    test::patch(file, kSectionTable + 16, 8, size);
    test::seal(file);
    expect_error(file, "bad_section_table", kSectionTable + 24, kSectionTable + 24,
                 "TOP of " + std::to_string(size));
  }
}

// Integers are exact (CNV-1): no section begins where the sum wraps to.
TEST(HeaderErrors, ASectionDoesNotBeginAtASumModuloTwoToThe64) {
  Bytes file = good_file();
  test::patch(file, kSectionTable + 16, 8, uint64_t{0} - 100);
  test::patch(file, kSectionTable + 24 + 8, 8, kHeaderBytes - 100);
  test::seal(file);
  expect_error(file, "bad_section_table", kSectionTable + 24, kSectionTable + 24);
}

TEST(HeaderErrors, EveryTruncation) {
  const Bytes file = good_file();
  for (size_t length = 0; length < file.size(); ++length) {
    expect_error(std::span(file).first(length), "truncated", length, length);
  }
}

// Fewer than 12 bytes are too few to say more, whatever they are.
TEST(HeaderErrors, ShortFilesAreTruncatedWhateverTheyHold) {
  for (size_t length = 0; length < 12; ++length) {
    expect_error(Bytes(length, 0x55), "truncated", length, length);
  }
  expect_error(Bytes(12, 0x55), "bad_magic", 0, 7);
}

TEST(HeaderErrors, EveryAppendedByteIsTrailing) {
  Bytes file = good_file();
  for (int i = 0; i < 3; ++i) {
    file.push_back(0);
    expect_error(file, "trailing_bytes", kHeaderBytes + 24, kHeaderBytes + 24);
  }
}

// Without a new header_crc, each flipped bit of the header is found.
TEST(HeaderErrors, EverySingleBitFlip) {
  for (size_t bit = 0; bit < kHeaderBytes * 8; ++bit) {
    Bytes file = good_file();
    file[bit / 8] ^= static_cast<uint8_t>(1u << (bit % 8));
    const auto parsed = parse_header(file);
    ASSERT_FALSE(parsed.has_value()) << bit;
    const size_t byte = bit / 8;
    const std::string_view name = error_name(parsed.error().code);
    if (byte < 8) {
      EXPECT_EQ(name, "bad_magic");
    } else if (byte == 8) {
      EXPECT_EQ(name, "bad_version");
    } else if (byte == 10 || byte == 11) {
      EXPECT_TRUE(name == "truncated" || name == "bad_header_crc") << name;
    } else {
      EXPECT_EQ(name, "bad_header_crc") << bit;
    }
  }
}

}  // namespace
}  // namespace hmlfc
