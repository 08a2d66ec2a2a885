// Section 9 of docs/rendering.md, worked by hand.
#include <gtest/gtest.h>

#include <initializer_list>
#include <limits>

#include "render/surface.hpp"

namespace hmlfc {
namespace {

int32_t chosen(std::initializer_list<std::pair<int32_t, int32_t>> proposals) {
  Proposals all;
  for (const auto& [displacement, weight] : proposals) all.add(displacement, weight);
  return all.chosen();
}

// SRF-3.
TEST(Surface, TheMedianIsTheLeastProposalWithHalfOfTheWeight) {
  EXPECT_EQ(chosen({{-700, 65536}}), -700);
  EXPECT_EQ(chosen({{300, 16384}, {100, 16384}, {200, 16384}, {400, 16384}}), 200);
  EXPECT_EQ(chosen({{100, 32768}, {200, 32768}}), 100);
  EXPECT_EQ(chosen({{100, 32767}, {200, 32769}}), 200);
  EXPECT_EQ(chosen({{200, 20000}, {100, 20000}, {200, 20000}, {900, 5536}}), 200);
}

// SRF-3: 5/8 of the weight, up to 8 pixels away.
TEST(Surface, WhereViewsDisagreeThePlaneHolds) {
  EXPECT_EQ(chosen({{50, 40960}, {5000, 24576}}), 50);
  EXPECT_EQ(chosen({{50, 40959}, {5000, 24577}}), 0);
  EXPECT_EQ(chosen({{50, 32768}, {50 + 2048, 8192}, {5000, 24576}}), 50);
  EXPECT_EQ(chosen({{50, 32768}, {50 + 2049, 8192}, {5000, 24576}}), 0);
  EXPECT_EQ(chosen({{-1998 - 1, 8192}, {50, 32768}, {5000, 24576}}), 0);
}

// SRF-3: what a block tells.
TEST(Surface, DisplacementsAreDisparitiesLessTheFocus) {
  FrameRecord record;
  record.focus = 256;
  EXPECT_EQ(displacement_of({-300, 1}, record), -556);
  EXPECT_EQ(displacement_of({-300, 0}, record), 0);
  record.fine = 20;
  EXPECT_EQ(displacement_of({-19, 1}, record), -256);
  EXPECT_EQ(displacement_of({19, 1}, record), -256);
  EXPECT_EQ(displacement_of({-20, 1}, record), -276);
  EXPECT_EQ(displacement_of({20, 1}, record), -236);
  constexpr auto kLeast = std::numeric_limits<int16_t>::min();
  constexpr auto kGreatest = std::numeric_limits<int16_t>::max();
  record.focus = 1;
  EXPECT_EQ(displacement_of({kLeast, 3}, record), kLeast);
  record.focus = -65536;
  EXPECT_EQ(displacement_of({kGreatest, 3}, record), kGreatest);
}

// SRF-2: 2 pixels a column, half a column to the right of the ray, are a pixel.
TEST(Surface, PlacesMoveWithTheDistanceOfTheView) {
  EXPECT_EQ(displacement_in_view(512, 3, (5 << 16) / 2), 1 << 12);
  EXPECT_EQ(displacement_in_view(512, 2, (5 << 16) / 2), -(1 << 12));
  EXPECT_EQ(displacement_in_view(512, 2, 2 << 16), 0);
  EXPECT_EQ(displacement_in_view(1, 0, -(1 << 15)), 8);
  EXPECT_EQ(displacement_in_view(-1, 0, 16), 0);  // 1 * 2^-8, towards minus infinity
  EXPECT_EQ(displacement_in_view(1, 0, 16), -1);
}

// SRF-2: rows twice as far apart as columns, and half as far the other way.
TEST(Surface, RowsAreDisplacedByTheirPitch) {
  EXPECT_EQ(displacement_a_row(300, 512), 600);
  EXPECT_EQ(displacement_a_row(301, -128), -150);  // -150.5, halves up
  EXPECT_EQ(displacement_a_row(-32768, 2032), -260096);
}

}  // namespace
}  // namespace hmlfc
