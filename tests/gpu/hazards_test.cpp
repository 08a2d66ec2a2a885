// The check of barriers, which follows every submission of the other tests.
#include <string>

#include <gtest/gtest.h>

#include "device/hazards.hpp"

namespace hmlfc::gpu {
namespace {

constexpr uint64_t kBuffer = 0x1000;
constexpr uint64_t kOther = 0x2000;

BufferAccess reads(uint64_t buffer) { return {buffer, "it", true, false}; }
BufferAccess writes(uint64_t buffer) { return {buffer, "it", false, true}; }

// A submission that has begun, with its first barrier.
Hazards begun() {
  Hazards hazards;
  hazards.begin();
  hazards.barrier(kCompute | kTransfer, kCompute | kTransfer);
  return hazards;
}

void add(Hazards& hazards, const std::string& command, Work work, const BufferAccess& access) {
  hazards.command(command);
  hazards.access(work, access);
}

TEST(Hazards, OfAWriteAndAReadNeedABarrierOfTheirWork) {
  for (const unsigned before : {0u, unsigned{kCompute}, unsigned{kTransfer}}) {
    for (const unsigned after : {0u, unsigned{kCompute}, unsigned{kTransfer}}) {
      Hazards hazards = begun();
      add(hazards, "a", kCompute, writes(kBuffer));
      hazards.barrier(before, after);
      add(hazards, "b", kTransfer, reads(kBuffer));
      EXPECT_EQ(hazards.end().empty(), before == kCompute && after == kTransfer);
    }
  }
}

TEST(Hazards, AreNamedWithBothCommands) {
  Hazards hazards = begun();
  add(hazards, "walk", kCompute, writes(kBuffer));
  add(hazards, "samples", kCompute, reads(kBuffer));
  EXPECT_EQ(hazards.end(),
            "samples reads it, which walk writes, without a barrier from compute to compute");
}

TEST(Hazards, AreWritesAfterReadsAndAfterWrites) {
  for (const BufferAccess& first : {reads(kBuffer), writes(kBuffer)}) {
    Hazards hazards = begun();
    add(hazards, "a", kCompute, first);
    add(hazards, "b", kCompute, writes(kBuffer));
    EXPECT_NE(hazards.end(), "");
  }
}

TEST(Hazards, AreNotReadsAloneNorOtherBytes) {
  Hazards hazards = begun();
  add(hazards, "a", kCompute, reads(kBuffer));
  add(hazards, "b", kTransfer, reads(kBuffer));
  add(hazards, "c", kTransfer, writes(kOther));
  add(hazards, "d", kTransfer, {kBuffer + 8, "it", false, true, 0, 4});
  add(hazards, "e", kTransfer, {kBuffer + 8, "it", false, true, 4, 8});
  EXPECT_EQ(hazards.end(), "");
}

TEST(Hazards, OfPartsAreThoseOfTheWhole) {
  Hazards hazards = begun();
  hazards.join(kOther, kBuffer, 4);
  add(hazards, "a", kTransfer, {kOther, "it", false, true, 0, 4});
  add(hazards, "b", kCompute, {kBuffer, "it", true, false, 0, 4});
  EXPECT_EQ(hazards.end(), "");
  add(hazards, "c", kCompute, {kBuffer, "it", true, false, 4, 8});
  EXPECT_NE(hazards.end(), "");
}

TEST(Hazards, OfEarlierSubmissionsAreThoseOfTheirWrites) {
  for (const bool visible : {false, true}) {
    Hazards hazards = begun();
    add(hazards, "a", kCompute, reads(kOther));
    add(hazards, "a", kCompute, writes(kBuffer));
    EXPECT_EQ(hazards.end(), "");
    hazards.finished(1);
    hazards.begin();
    hazards.barrier(visible ? kCompute : kTransfer, kCompute);
    add(hazards, "b", kCompute, writes(kOther));
    add(hazards, "b", kCompute, reads(kBuffer));
    EXPECT_EQ(hazards.end().empty(), visible);
  }
}

// What was read, and what was written, by a submission that may still be under way.
TEST(Hazards, OfWritesAfterSubmissionsUnderWay) {
  for (const BufferAccess& before : {reads(kBuffer), writes(kBuffer)}) {
    for (const bool finished : {false, true}) {
      for (const bool ordered : {false, true}) {
        Hazards hazards = begun();
        add(hazards, "a", kCompute, before);
        EXPECT_EQ(hazards.end(), "");
        if (finished) hazards.finished(1);
        hazards.begin();
        hazards.barrier(ordered ? kCompute : kTransfer, kCompute);
        add(hazards, "b", kCompute, writes(kBuffer));
        EXPECT_EQ(hazards.end().empty(), finished || ordered);
      }
    }
  }
}

TEST(Hazards, EndWithABufferOfTheSameAddress) {
  Hazards hazards = begun();
  add(hazards, "a", kCompute, writes(kBuffer));
  hazards.add_buffer(kBuffer);
  add(hazards, "b", kCompute, reads(kBuffer));
  EXPECT_EQ(hazards.end(), "");
}

TEST(Hazards, NameIdleBarriers) {
  Hazards hazards = begun();
  add(hazards, "a", kCompute, writes(kBuffer));
  hazards.barrier(kCompute | kTransfer, kCompute);
  add(hazards, "b", kCompute, reads(kBuffer));
  EXPECT_EQ(hazards.end(), "nothing needs that the barrier after a waits for transfer");
  hazards.begin();
  hazards.barrier(kCompute, kCompute);
  add(hazards, "a", kCompute, writes(kBuffer));
  hazards.barrier(kCompute, kCompute);
  hazards.barrier(kCompute, kCompute);
  add(hazards, "b", kCompute, reads(kBuffer));
  EXPECT_NE(hazards.end(), "");
}

}  // namespace
}  // namespace hmlfc::gpu
