// ReadTraffic: bytes by part, and those of beats that were read before.
#include "systemc/read_traffic.hpp"

#include <gtest/gtest.h>

namespace hmlfc::test {
namespace {

constexpr uint64_t kStream = 0x1000;
constexpr uint64_t kArea = 0x4000;
constexpr unsigned kBeat = 16;

tb::ReadTraffic some_traffic() {
  StreamHeader header;
  const auto section = [&](Section name) -> SectionEntry& {
    return header.sections[static_cast<size_t>(name) - 1];
  };
  section(Section::kRoot).offset = 0x100;
  section(Section::kRoot).size = 0x20;
  section(Section::kGroup).offset = 0x120;
  section(Section::kGroup).size = 0x20;
  section(Section::kTile).offset = 0x140;
  section(Section::kTile).size = 0x100;
  tb::AreaLayout layout;
  layout.planes.push_back({0, {}, Plane::kY, 0, 0x90});
  layout.planes.push_back({0, {}, Plane::kCg, 0x90, 0x90});
  layout.size = 0x120;
  return {{.stream = {}, .reference_area = {}, .stream_base = kStream, .reference_base = kArea},
          header,
          layout};
}

TEST(ReadTraffic, CountsByPart) {
  tb::ReadTraffic traffic = some_traffic();
  traffic.add(kStream + 0x100, 1, kBeat);
  traffic.add(kStream + 0x130, 2, kBeat);  // the second beat is of a tile
  traffic.add(kStream + 0x240, 1, kBeat);  // behind the tiles
  traffic.add(kArea + 0x80, 3, kBeat);
  EXPECT_EQ(traffic.of(tb::ReadPart::kRoot).bytes, 16u);
  EXPECT_EQ(traffic.of(tb::ReadPart::kGroup).bytes, 16u);
  EXPECT_EQ(traffic.of(tb::ReadPart::kTile).bytes, 16u);
  EXPECT_EQ(traffic.of(tb::ReadPart::kOther).bytes, 16u);
  EXPECT_EQ(traffic.of(tb::ReadPart::kLuma).bytes, 16u);
  EXPECT_EQ(traffic.of(tb::ReadPart::kChroma).bytes, 32u);
  EXPECT_EQ(traffic.of(tb::ReadPart::kChroma).again, 0u);
}

TEST(ReadTraffic, CountsBeatsReadBefore) {
  tb::ReadTraffic traffic = some_traffic();
  traffic.add(kArea, 2, kBeat);
  traffic.add(kArea + 0x10, 3, kBeat);
  traffic.add(kArea + 0x10, 1, kBeat);
  EXPECT_EQ(traffic.of(tb::ReadPart::kLuma).bytes, 6u * kBeat);
  EXPECT_EQ(traffic.of(tb::ReadPart::kLuma).again, 2u * kBeat);
}

}  // namespace
}  // namespace hmlfc::test
