// hmlfc_header against parse_header of the model: every field, every check of FIL-4, bus errors.
#include <cstdint>
#include <map>

#include <Header.h>

#include "rtl/ports.hpp"
#include "rtl/read_port.hpp"
#include "support/streams.hpp"
#include "syntax/header.hpp"

namespace hmlfc::test {
namespace {

constexpr size_t kVersionByte = 8;  // FIL-1
constexpr size_t kProfileByte = 9;
constexpr size_t kHeaderBytesByte = 10;
constexpr size_t kFeatureByte = 12;
constexpr size_t kRowsByte = 16;
constexpr size_t kCrcBytes = 4;

uint32_t any(Random& random, int32_t lo, int32_t hi) {
  return static_cast<uint32_t>(random.often_extreme(lo, hi));
}

/// The fields of profile extended, each with the flag that it needs (EXT-1, EXT-2).
void add_extended_fields(StreamHeader& header, Random& random) {
  header.profile = Profile::kExtended;
  const auto use = [&](Feature feature) {
    const bool used = random.one_in(2);
    if (used) header.feature_flags |= feature_bit(feature);
    return used;
  };
  use(Feature::kResidualStep);
  use(Feature::kLossyKeys);
  if (use(Feature::kLevelKeys)) header.levels[0].key_references = 0;
  use(Feature::kCameraRig);
  if (!use(Feature::kMotionTiles)) return;
  header.motion_tile_log2 = any(random, 5, 7);
  if (use(Feature::kSubpelVectors)) header.vector_precision = any(random, 1, 3);
  if (use(Feature::kSharedDisparity)) {
    header.disparity_precision = any(random, static_cast<int32_t>(header.vector_precision), 5);
    header.disparity_grid_log2 = any(random, 2, 5);
    header.row_scale = random.often_extreme(-127, 127);
  }
}

/// A valid file over the whole intervals of the header's fields; its sections are a few bytes each.
Bytes some_file(Random& random) {
  StreamHeader header = some_header(random.often_extreme(0, kMaxTreeHeight));
  header.rows = any(random, 1, kMaxGrid);
  header.cols = any(random, 1, kMaxGrid);
  header.width = any(random, 1, kMaxSide);
  header.height = any(random, 1, kMaxSide);
  header.depth = random.in(8, 12);
  header.chroma_format = random.one_in(2) ? ChromaFormat::k420 : ChromaFormat::k444;
  header.block_log2 = any(random, 1, 3);
  header.window = random.often_extreme(0, kMaxWindow);
  header.cluster_rows = any(random, 1, 255);
  header.cluster_cols = any(random, 2, 255);
  if (random.one_in(2)) add_extended_fields(header, random);
  SectionBytes sections;
  for (Bytes& section : sections) section.resize(any(random, 0, 40), 0x5A);
  return file_of(header, sections, Bytes(any(random, 0, 40), 0xA5));
}

/// One wrong thing in `file`, at a place and with a value by chance; the CRC is right afterwards,
/// but for damage to the CRC itself.
void damage(Bytes& file, size_t header_bytes, Random& random) {
  const auto byte = [&](size_t at) {
    file[at] = static_cast<uint8_t>(random.often_extreme(0, 255));
  };
  const int kind = random.in(0, 9);
  if (kind == 0) return file.resize(any(random, 0, static_cast<int32_t>(file.size()) - 1));
  if (kind == 1) return file.push_back(0);
  if (kind == 2) return byte(any(random, 0, static_cast<int32_t>(kVersionByte)));
  if (kind == 3) return byte(header_bytes - any(random, 1, kCrcBytes));
  if (kind == 4) byte(kProfileByte);
  if (kind == 5) byte(kFeatureByte + any(random, 0, 3));
  if (kind > 5) {
    byte(any(random, kRowsByte, static_cast<int32_t>(header_bytes - kCrcBytes) - 1));
  }
  seal(file);
}

template <class Dut>
uint8_t parse(Dut& dut, ReadPort& port, uint64_t bytes) {
  port.corrupted = false;
  dut.start = 1;
  dut.stream_base = ReadPort::kBase;
  dut.stream_bytes = bytes;
  for (int clocks = 0; clocks < 10'000; ++clocks) {
    port.drive(dut);
    dut.eval();
    port.watch(dut);
    tick(dut);
    dut.start = 0;
    if (dut.done) return dut.error;
  }
  ADD_FAILURE() << "no end";
  return 0;
}

void compare_extended_fields(const Header& dut, const StreamHeader& header, Counts& counts) {
  counts.compare(dut.features, header.feature_flags & ~feature_bit(Feature::kCameraRig));
  counts.compare(dut.vector_precision, header.vector_precision);
  counts.compare(dut.disparity_precision, header.disparity_precision);
  counts.compare(dut.motion_tile_log2, header.motion_tile_log2);
  counts.compare(dut.disparity_grid_log2, header.disparity_grid_log2);
  counts.compare(static_cast<int8_t>(dut.row_scale), header.row_scale);
}

void compare_fields(const Header& dut, const StreamHeader& header, Counts& counts) {
  counts.compare(dut.rows, header.rows);
  counts.compare(dut.cols, header.cols);
  counts.compare(dut.width, header.width);
  counts.compare(dut.height, header.height);
  counts.compare(dut.depth, header.depth);
  counts.compare(dut.chroma_444, header.chroma_format == ChromaFormat::k444);
  counts.compare(dut.block_log2, header.block_log2);
  counts.compare(dut.window, header.window);
  counts.compare(dut.cluster_rows, header.cluster_rows);
  counts.compare(dut.cluster_cols, header.cluster_cols);
  counts.compare(dut.tree_height, header.tree_height);
  compare_extended_fields(dut, header, counts);
}

void compare_tables(const Header& dut, const StreamHeader& header, Counts& counts) {
  for (int level = 0; level <= header.tree_height; ++level) {
    const LevelEntry& entry = header.levels[static_cast<size_t>(level)];
    const auto at = 24 * static_cast<size_t>(level);
    counts.compare(get_bits(dut.levels, at, 8), entry.ref_rows);
    counts.compare(get_bits(dut.levels, at + 8, 8), entry.ref_cols);
    counts.compare(get_bits(dut.levels, at + 16, 8), entry.key_references);
  }
  const auto same = [&](uint64_t got, uint64_t expected) {
    counts.compare(static_cast<int64_t>(got), static_cast<int64_t>(expected));
  };
  same(dut.root_offset, header.sections[1].offset);
  same(dut.root_size, header.sections[1].size);
  same(dut.group_offset, header.sections[2].offset);
  same(dut.group_size, header.sections[2].size);
  same(dut.tile_offset, header.sections[3].offset);
  same(dut.tile_size, header.sections[3].size);
}

TEST(HeaderModule, ReadsEveryField) {
  Header dut;
  reset(dut);
  Random random(1);
  Counts counts;
  for (int turn = 0; turn < 1000; ++turn) {
    const Bytes file = some_file(random);
    const auto header = parse_header(file);
    ASSERT_TRUE(header) << to_string(header.error());
    ReadPort port(file, random);
    counts.compare(parse(dut, port, file.size()), 0);
    compare_fields(dut, *header, counts);
    compare_tables(dut, *header, counts);
  }
  expect_equal(counts, 24'000);
}

/// Errors of damaged headers, how often each was given, and how many were not the model's.
struct Refusals {
  std::map<ErrorCode, int> seen;
  Counts counts;
};

template <class Dut>
Refusals refuse(int turns) {
  Dut dut;
  reset(dut);
  Random random(2);
  Refusals refusals;
  for (int turn = 0; turn < turns; ++turn) {
    Bytes file = some_file(random);
    damage(file, header_size(parse_header(file).value()), random);
    const auto header = parse_header(file);
    const ErrorCode expected = header ? ErrorCode::kOk : header.error().code;
    ReadPort port(file, random);
    refusals.counts.compare(parse(dut, port, file.size()), static_cast<uint8_t>(expected));
    ++refusals.seen[expected];
  }
  return refusals;
}

TEST(HeaderModule, RefusesWhatTheModelRefuses) {
  const Refusals refusals = refuse<Header>(6000);
  expect_equal(refusals.counts, 6000);
  for (auto code = ErrorCode::kOk; code <= ErrorCode::kTrailingBytes;
       code = static_cast<ErrorCode>(static_cast<uint8_t>(code) + 1)) {
    EXPECT_TRUE(refusals.seen.contains(code)) << error_name(code);
  }
}

/// FIL-4: magic, version and header_bytes are checked before all that follows them, wherever the
/// header says that it ends.
TEST(HeaderModule, RefusesEveryShortHeader) {
  Header dut;
  reset(dut);
  Random random(4);
  Counts counts;
  for (int size = 0; size < 148; ++size) {
    for (const size_t broken : {kHeaderBytesByte, kVersionByte, size_t{0}}) {
      Bytes file = some_file(random);
      file[kHeaderBytesByte] = static_cast<uint8_t>(size);
      file[kHeaderBytesByte + 1] = 0;
      if (broken != kHeaderBytesByte) file[broken] ^= 0xFF;
      ReadPort port(file, random);
      counts.compare(parse(dut, port, file.size()),
                     static_cast<uint8_t>(parse_header(file).error().code));
    }
  }
  expect_equal(counts, 3 * 148);
}

TEST(HeaderModule, KeepsNothingOfABusError) {
  Header dut;
  reset(dut);
  Random random(3);
  Counts counts;
  for (int turn = 0; turn < 600; ++turn) {
    const Bytes file = some_file(random);
    ReadPort port(file, random);
    port.corrupt = random.one_in(2);
    const uint8_t error = parse(dut, port, file.size());
    counts.compare(error, port.corrupted ? ReadPort::kBusError : 0);
    if (error == 0) compare_fields(dut, parse_header(file).value(), counts);
  }
  expect_equal(counts, 2000);
}

}  // namespace
}  // namespace hmlfc::test
