// hmlfc_tile_walk against find_tile of the model, on intact and damaged streams, with bus errors.
#include <cstdint>
#include <optional>
#include <vector>

#include <TileWalk.h>

#include "rtl/ports.hpp"
#include "rtl/read_port.hpp"
#include "syntax/geometry.hpp"
#include "syntax/header.hpp"
#include "syntax/index.hpp"
#include "vectors/field_stream.hpp"

namespace hmlfc::test {
namespace {

/// Sets the fields of config_t that the walk reads; they are its lowest bits.
void set_stream(TileWalk& dut, const StreamHeader& header) {
  const auto put40 = [&](size_t at, uint64_t value, unsigned width) {
    put_bits(dut.stream, at, 20, static_cast<int64_t>(value & 0xFFFFF));
    put_bits(dut.stream, at + 20, width - 20, static_cast<int64_t>(value >> 20));
  };
  const auto& sections = header.sections;  // TOP, ROOT, GROUP, TILE
  put40(0, sections[3].size, 40);
  put40(40, ReadPort::kBase + sections[3].offset, 40);
  put40(80, sections[2].size / kGroupRecordBytes, 36);
  put40(116, ReadPort::kBase + sections[2].offset, 40);
  put40(156, ReadPort::kBase + sections[1].offset, 40);
}

struct Walked {
  uint8_t error;
  bool empty;
  uint64_t address, bytes;
};

Walked walk(TileWalk& dut, ReadPort& port, uint64_t tile) {
  port.corrupted = false;
  port.requests = 0;
  dut.start = 1;
  dut.tile = tile;
  for (int clocks = 0; clocks < 2000; ++clocks) {
    port.drive(dut);
    dut.eval();
    port.watch(dut);
    tick(dut);
    dut.start = 0;
    if (dut.done) return {dut.error, dut.empty != 0, dut.record_address, dut.record_bytes};
  }
  ADD_FAILURE() << "tile " << tile << ": no end";
  return {};
}

void flush(TileWalk& dut) {
  dut.flush = 1;
  tick(dut);
  dut.flush = 0;
}

void expect_found(const Walked& got, const Result<std::optional<TileExtent>>& found,
                  uint64_t tile_section, Counts& counts) {
  counts.compare(got.error, found ? 0 : static_cast<int64_t>(found.error().code));
  if (!found || got.error != 0) return;
  counts.compare(got.empty, !found->has_value());
  if (!found->has_value() || got.empty) return;
  counts.compare(static_cast<int64_t>(got.address),
                 static_cast<int64_t>(ReadPort::kBase + tile_section + (*found)->begin));
  counts.compare(static_cast<int64_t>(got.bytes),
                 static_cast<int64_t>((*found)->end - (*found)->begin));
}

/// Random tiles of one stream, near each other or far.
void run_stream(uint32_t seed, bool damaged, bool corrupt, Counts& counts) {
  std::vector<uint8_t> file = vectors::random_stream(seed, {});
  const StreamHeader header = parse_header(file).value();
  Random random(seed);
  for (uint64_t i = header.sections[1].offset; damaged && i < file.size(); ++i) {
    if (random.one_in(60))
      file[static_cast<size_t>(i)] ^= static_cast<uint8_t>(1 << random.in(0, 7));
  }
  const StreamView view{file, header, Geometry(header)};
  TileWalk dut;
  reset(dut);
  set_stream(dut, header);
  ReadPort port(file, random);
  const auto tiles = static_cast<int32_t>(view.geometry.tile_count());
  int32_t tile = 0;
  for (int turn = 0; turn < 300; ++turn) {
    tile = random.one_in(3) ? random.in(0, tiles - 1) : (tile + random.in(0, 3)) % tiles;
    if (random.one_in(100)) flush(dut);
    port.corrupt = corrupt && random.one_in(2);
    const Walked got = walk(dut, port, static_cast<uint64_t>(tile));
    if (port.corrupted) {
      counts.compare(got.error, ReadPort::kBusError);
    } else {
      expect_found(got, find_tile(view, static_cast<uint64_t>(tile), Probe{}),
                   header.sections[3].offset, counts);
    }
  }
}

TEST(TileWalk, FindsWhatTheModelFinds) {
  Counts counts;
  for (uint32_t seed = 0; seed < 20; ++seed) run_stream(seed, false, false, counts);
  expect_equal(counts, 12'000);
}

TEST(TileWalk, RefusesWhatTheModelRefuses) {
  Counts counts;
  for (uint32_t seed = 0; seed < 20; ++seed) run_stream(seed, true, false, counts);
  expect_equal(counts, 8'000);
}

// What a bus error brought is not kept: later walks are right.
TEST(TileWalk, KeepsNothingOfABusError) {
  Counts counts;
  for (uint32_t seed = 0; seed < 20; ++seed) run_stream(seed, seed % 2 == 1, true, counts);
  expect_equal(counts, 8'000);
}

// A tile of a group that was seen before costs one read.
TEST(TileWalk, KeepsTheGroupsItHasSeen) {
  const std::vector<uint8_t> file = vectors::random_stream(4, {});
  const StreamHeader header = parse_header(file).value();
  const StreamView view{file, header, Geometry(header)};
  Random random(1);
  TileWalk dut;
  reset(dut);
  set_stream(dut, header);
  ReadPort port(file, random);
  uint64_t there = 0;
  while (!find_tile(view, there, Probe{}).value()) ++there;
  walk(dut, port, there);
  EXPECT_EQ(port.requests, 3u) << "root entry, group record, end table";
  walk(dut, port, there);
  EXPECT_EQ(port.requests, 1u);
  flush(dut);
  walk(dut, port, there);
  EXPECT_EQ(port.requests, 3u);
}

}  // namespace
}  // namespace hmlfc::test
