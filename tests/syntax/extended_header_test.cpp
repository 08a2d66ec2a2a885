// Flags and fields of profile extended: each alone, each end of each interval, each fault (EXT-1,
// EXT-2, EXT-4).
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "support/streams.hpp"
#include "syntax/header.hpp"

namespace hmlfc {
namespace {

using test::Bytes;

constexpr size_t kAtLevels = 44;

// The flags that each of the ten needs, by bit (EXT-1): subpel_vectors, shared_disparity,
// two_references and chroma_motion need motion_tiles.
constexpr uint32_t kNeeds[] = {0, 0, 2, 2, 2, 2, 0, 0, 0, 0};

/// The fields of EXT-2 and whether their flags are set.
struct HeaderField {
  const char* name;
  size_t offset;
  uint32_t flag;
  int lo;
  int hi;
};

std::vector<HeaderField> fields_of(uint32_t flags, int vector_precision) {
  return {{"vector_precision", 35, flags & 4, 1, 3},
          {"disparity_precision", 36, flags & 8, vector_precision, 5},
          {"motion_tile_log2", 37, flags & 2, 5, 7},
          {"disparity_grid_log2", 38, flags & 8, 2, 5},
          {"row_scale", 39, flags & 8, -127, 127}};
}

StreamHeader header_with(uint32_t flags, int vector_precision = 1) {
  StreamHeader header = test::some_header(2);
  header.profile = Profile::kExtended;
  header.feature_flags = flags;
  if ((flags & 4) != 0) header.vector_precision = static_cast<unsigned>(vector_precision);
  if ((flags & 8) != 0) {
    header.disparity_precision = header.vector_precision;
    header.disparity_grid_log2 = 2;
  }
  if ((flags & 2) != 0) header.motion_tile_log2 = 5;
  return header;
}

bool fits(uint32_t flags) {
  for (unsigned bit = 0; bit < 10; ++bit) {
    const bool set = (flags >> bit & 1) != 0;
    if (set && (flags & kNeeds[bit]) != kNeeds[bit]) return false;
  }
  return true;
}

std::string outcome(const Bytes& file, size_t* offset = nullptr) {
  const auto parsed = parse_header(file);
  if (parsed) return "ok";
  if (offset != nullptr) *offset = static_cast<size_t>(parsed.error().offset);
  return std::string(error_name(parsed.error().code));
}

TEST(ExtendedHeader, EveryCombinationOfFlags) {
  int valid = 0;
  for (uint32_t flags = 0; flags < 1024; ++flags) {
    const StreamHeader header = header_with(flags);
    size_t offset = 0;
    ASSERT_EQ(outcome(test::file_of(header, {}), &offset), fits(flags) ? "ok" : "bad_feature")
        << flags;
    ASSERT_EQ(check_fields(header).has_value(), fits(flags)) << flags;
    if (!fits(flags)) {
      EXPECT_EQ(offset, 12u);
    }
    valid += fits(flags) ? 1 : 0;
  }
  EXPECT_EQ(valid, 544) << "32 without motion tiles, 512 with them";
}

TEST(ExtendedHeader, UnknownFlags) {
  for (unsigned bit = 10; bit < 32; ++bit) {
    for (const uint32_t others : {0u, 1023u}) {
      EXPECT_EQ(outcome(test::file_of(header_with(others | uint32_t{1} << bit), {})), "bad_feature")
          << bit;
    }
  }
}

TEST(ExtendedHeader, NoFlagInProfileMain) {
  for (unsigned bit = 0; bit < 32; ++bit) {
    StreamHeader header = test::some_header(0);
    header.feature_flags = uint32_t{1} << bit;
    EXPECT_EQ(outcome(test::file_of(header, {})), "bad_feature") << bit;
  }
}

// Every value of every field with every set of flags that it depends on.
TEST(ExtendedHeader, EveryValueOfEveryField) {
  for (uint32_t flags = 0; flags < 16; ++flags) {
    if (!fits(flags)) continue;
    for (int precision = 1; precision <= 3; ++precision) {
      const Bytes file = test::file_of(header_with(flags, precision), {});
      const int lowest = (flags & 4) != 0 ? precision : 0;
      for (const HeaderField& field : fields_of(flags, lowest)) {
        for (int byte = 0; byte < 256; ++byte) {
          Bytes changed = file;
          test::patch(changed, field.offset, 1, static_cast<uint64_t>(byte));
          test::seal(changed);
          const bool is_signed = field.lo < 0;
          const int value = is_signed && byte > 127 ? byte - 256 : byte;
          bool valid = field.flag != 0 ? value >= field.lo && value <= field.hi : value == 0;
          size_t where = field.offset;
          // Disparities must be at least as fine as vectors.
          if (valid && field.offset == 35 && (flags & 8) != 0 && value > precision) {
            valid = false;
            where = 36;
          }
          size_t offset = 0;
          ASSERT_EQ(outcome(changed, &offset), valid ? "ok" : "bad_header_field")
              << field.name << " = " << value << " with flags " << flags;
          if (!valid) {
            ASSERT_EQ(offset, where) << field.name << " = " << value;
          }
        }
      }
    }
  }
}

TEST(ExtendedHeader, ReservedBytes) {
  for (const uint32_t flags : {0u, 1023u}) {
    for (size_t at = 40; at < 44; ++at) {
      Bytes file = test::file_of(header_with(flags), {});
      test::patch(file, at, 1, 0x80);
      test::seal(file);
      size_t offset = 0;
      EXPECT_EQ(outcome(file, &offset), "bad_header_field") << at;
      EXPECT_GE(offset, 40u);
      EXPECT_LE(offset, at);
    }
  }
}

// Of two faults the first of FIL-4 and EXT-2 counts.
TEST(ExtendedHeader, OrderOfChecks) {
  struct Fault {
    size_t offset;
    uint64_t value;
    size_t reported;
  };
  // tree_height, the fields of EXT-2, a reserved byte, header_bytes, key_references at the top.
  const std::vector<Fault> faults{{34, 16, 34}, {35, 9, 35},   {36, 9, 36},
                                  {37, 9, 37},  {38, 9, 38},   {39, 128, 39},
                                  {41, 1, 40},  {10, 160, 10}, {46, 1, 46}};
  for (size_t i = 0; i < faults.size(); ++i) {
    for (size_t j = i; j < faults.size(); ++j) {
      Bytes file = test::file_of(header_with(1023), {Bytes(8), Bytes(8), Bytes(8), Bytes(8)});
      for (const Fault& fault : {faults[i], faults[j]}) {
        test::patch(file, fault.offset, 1, fault.value);
      }
      test::seal(file);
      size_t offset = 0;
      ASSERT_EQ(outcome(file, &offset), "bad_header_field");
      EXPECT_EQ(offset, faults[i].reported) << faults[i].offset << " and " << faults[j].offset;
    }
  }
}

TEST(ExtendedHeader, KeyReferences) {
  constexpr uint32_t kLevelKeys = 128;
  for (const uint32_t flags : {0u, 1023u - kLevelKeys, kLevelKeys, 1023u}) {
    for (size_t entry = 0; entry < 3; ++entry) {  // from the top down
      for (int value = 0; value < 256; ++value) {
        Bytes file = test::file_of(header_with(flags), {});
        const size_t at = kAtLevels + 4 * entry + 2;
        test::patch(file, at, 1, static_cast<uint64_t>(value));
        test::seal(file);
        const bool allowed = (flags & kLevelKeys) != 0 && entry > 0;
        const bool valid = value == 0 || (value == 1 && allowed);
        size_t offset = 0;
        ASSERT_EQ(outcome(file, &offset), valid ? "ok" : "bad_header_field")
            << value << " in entry " << entry << " with flags " << flags;
        if (!valid) {
          ASSERT_EQ(offset, at);
          continue;
        }
        const StreamHeader header = parse_header(file).value();
        ASSERT_EQ(header.levels[2 - entry].key_references, value);
        ASSERT_EQ(write_header(header), Bytes(file.begin(), file.begin() + header_size(header)));
      }
    }
  }
}

RC_GTEST_PROP(ExtendedHeader, RoundTrip, ()) {
  uint32_t flags = *rc::gen::inRange(0u, 1024u);
  if ((flags & 60) != 0) flags |= 2;
  StreamHeader header = header_with(flags, *rc::gen::inRange(1, 4));
  if (header.has(Feature::kMotionTiles)) header.motion_tile_log2 = *rc::gen::inRange(5u, 8u);
  if (header.has(Feature::kSharedDisparity)) {
    header.disparity_precision = *rc::gen::inRange(header.vector_precision, 6u);
    header.disparity_grid_log2 = *rc::gen::inRange(2u, 6u);
    header.row_scale = *rc::gen::inRange(-127, 128);
  }
  for (size_t level = 0; level < 2; ++level) {
    if (header.has(Feature::kLevelKeys)) {
      header.levels[level].key_references = *rc::gen::inRange<uint8_t>(0, 2);
    }
  }
  const auto parsed = parse_header(test::file_of(header, {}));
  RC_ASSERT(parsed.has_value());
  header.sections = parsed->sections;
  header.rig = parsed->rig;
  RC_ASSERT(*parsed == header);
  RC_ASSERT(check_fields(header).has_value());
}

}  // namespace
}  // namespace hmlfc
