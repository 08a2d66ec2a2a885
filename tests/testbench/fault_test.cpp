// The bench finds what is planted: each fault of the stand-in is caught and named.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include "stimulus/sequences.hpp"
#include "systemc/failure_folder.hpp"
#include "systemc/stream_image.hpp"
#include "testbench/test_bench.hpp"
#include "unit/stand_in.hpp"

namespace hmlfc::tb {
namespace {

// The rule under which each fault must be found.
const std::map<Fault, std::string>& rules() {
  static const std::map<Fault, std::string> table{
      {Fault::kSample, "answer: sample"},
      {Fault::kStage, "stage: prediction"},
      {Fault::kVector, "stage: vector"},
      {Fault::kDropped, "answer: order"},
      {Fault::kDuplicated, "answer: order"},
      {Fault::kSwapped, "answer: order"},
      {Fault::kStatus, "answer: status"},
      {Fault::kLast, "answer: tlast"},
      {Fault::kUnstable, "protocol: answer changed or went away while it waited"},
      {Fault::kBurst, "protocol: burst crosses 4 KiB"},
      {Fault::kRecordMissing, "trace: record missing"},
      {Fault::kCounter, "registers: REQUESTS"},
      {Fault::kBlocks, "registers: BLOCKS"},
      {Fault::kNeighbour, "answer: status"},
  };
  return table;
}

// Half of the tile records.
FaultyRange some_records(const Bench& bench, const GoldenStream& golden) {
  const SectionEntry& tiles = golden.view().entry(Section::kTile);
  const uint64_t begin = bench.image().stream_base + tiles.offset + tiles.size / 2;
  return {begin, begin + tiles.size / 2, 2};
}

// One run of random blocks, half of them answered with back-pressure; with `bus_errors` some reads
// of records fail.
std::optional<Mismatch> run_with(Fault fault, bool stages, bool bus_errors = false) {
  const std::vector<uint8_t> bytes = main_stream(5, 5);
  const UnitParameters parameters{2, 12, 16, 16};
  StreamImage image(bytes, parameters);
  Bench& bench = test_bench();
  bench.attach(std::make_unique<StandIn>(parameters, fault));
  if (!stages) bench.compare_answers_only();
  image.load_into(bench);
  bench.begin_counting();
  Conditions conditions;
  conditions.backpressure = 500;
  const GoldenStream& golden = *image.golden();
  const BlockReads reads(golden);
  if (bus_errors) bench.begin_faults({some_records(bench, golden)}, reads);
  bench.run(mixed_requests(golden.geometry(), golden.header(), 500, 7, 0), image.oracle(),
            conditions, 9);
  bench.end_faults();
  if (!bench.findings().first()) bench.check_counters();
  return bench.findings().first();
}

TEST(Bench, PassesWhatIsRight) {
  const auto mismatch = run_with(Fault::kNone, true);
  EXPECT_FALSE(mismatch) << to_string(*mismatch);
  EXPECT_FALSE(run_with(Fault::kNone, false));
}

TEST(Bench, TakesBusErrorsOfTheMemory) {
  const auto mismatch = run_with(Fault::kNone, true, true);
  EXPECT_FALSE(mismatch) << to_string(*mismatch);
  EXPECT_GE(test_bench().scoreboard().counts().unchecked, 10u);
}

TEST(Bench, CatchesAndNamesEveryFault) {
  for (const Fault fault : kFaults) {
    const auto mismatch = run_with(fault, true, fault == Fault::kNeighbour);
    ASSERT_TRUE(mismatch) << "fault " << static_cast<int>(fault) << " is not caught";
    EXPECT_EQ(mismatch->rule.substr(0, rules().at(fault).size()), rules().at(fault))
        << to_string(*mismatch);
  }
}

TEST(Bench, NamesThePlaceOfAWrongStage) {
  const auto mismatch = run_with(Fault::kStage, true);
  ASSERT_TRUE(mismatch);
  EXPECT_NE(mismatch->place.find("level "), std::string::npos);
  EXPECT_NE(mismatch->detail.find("sample (0, 0): expected "), std::string::npos);
  ASSERT_TRUE(mismatch->request);
}

std::unique_ptr<DecodeUnit> make_faulty(const UnitParameters& parameters) {
  return std::make_unique<StandIn>(parameters, Fault::kSample);
}

TEST(Bench, KeepsWhatRepeatsAFailure) {
  const std::vector<uint8_t> bytes = main_stream(5, 5);
  const UnitMaker maker{"stand-in", {2, 12, 16, 16}, &make_faulty};
  StreamImage image(bytes, maker.parameters);
  RecordedSource recorded(64);
  Bench& bench = test_bench();
  bench.attach(maker.make(maker.parameters));
  image.load_into(bench);
  const GoldenStream& golden = *image.golden();
  bench.run(recorded.record(mixed_requests(golden.geometry(), golden.header(), 500, 7, 0)),
            image.oracle(), {}, 9);
  ASSERT_TRUE(bench.findings().first());
  const std::filesystem::path root = std::filesystem::path(testing::TempDir()) / "kept";
  const auto folder = keep_failure(
      bench, maker, image, {*bench.findings().first(), recorded.history(), "REPLAY", "id"}, root);
  std::ifstream message(folder / "message.txt");
  const std::string text{std::istreambuf_iterator<char>(message), {}};
  EXPECT_NE(text.find("answer: sample: view "), std::string::npos) << text;
  EXPECT_NE(text.find("requests around it: answer: sample"), std::string::npos) << text;
  EXPECT_NE(text.find("REPLAY"), std::string::npos);
  EXPECT_GT(std::filesystem::file_size(folder / "model.txt"), 1000u);
  EXPECT_GT(std::filesystem::file_size(folder / "unit.txt"), 1000u);
  std::filesystem::remove_all(root);
}

TEST(Bench, SeesOnlyAnswersWithoutStages) {
  EXPECT_FALSE(run_with(Fault::kStage, false));
  EXPECT_TRUE(run_with(Fault::kSample, false));
  EXPECT_TRUE(run_with(Fault::kBlocks, false));
}

}  // namespace
}  // namespace hmlfc::tb
