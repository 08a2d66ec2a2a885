// The bench finds and names what a unit does wrong at its pins.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "stimulus/sequences.hpp"
#include "systemc/failure_folder.hpp"
#include "systemc/stream_image.hpp"
#include "testbench/test_bench.hpp"
#include "unit/units.hpp"

namespace hmlfc::tb {
namespace {

constexpr uint64_t kFirstFaulty = 20;  // answer

struct Fault {
  const char* rule;                             // under which it must be found
  void (*spoil)(UnitOutputs& out, bool waits);  // `waits`: an answer was offered before, not taken
};

constexpr Fault kFaults[] = {
    {"answer: sample", [](UnitOutputs& out, bool) { out.answer.samples[0] ^= 1; }},
    {"answer: status", [](UnitOutputs& out, bool) { out.answer.status ^= 5; }},
    {"answer: tlast", [](UnitOutputs& out, bool) { out.answer.last = !out.answer.last; }},
    {"answer: missing", [](UnitOutputs& out, bool) { out.response_valid = false; }},
    {"stage: prediction",
     [](UnitOutputs& out, bool) {
       if (!out.trace.key) out.trace.prediction[0] ^= 4;
     }},
    {"stage: vector",
     [](UnitOutputs& out, bool) {
       if (out.trace.motion) ++out.trace.vectors[0].ix;
     }},
    {"trace: record missing", [](UnitOutputs& out, bool) { out.trace_valid = false; }},
    {"protocol: answer changed",
     [](UnitOutputs& out, bool waits) {
       if (waits) out.answer.samples[0] ^= 1;
     }},
    {"protocol: a read burst crosses 4 KiB",
     [](UnitOutputs& out, bool) {
       if (out.ar_len > 0) out.ar_addr |= 0xff0;
     }},
    {"registers: REQUESTS", [](UnitOutputs& out, bool) { ++out.lite_r_data; }}};

// A Verilated unit that is spoiled from an answer on.
class FaultyUnit final : public Unit {
 public:
  FaultyUnit(std::unique_ptr<Unit> unit, const Fault* fault)
      : unit_(std::move(unit)), fault_(fault) {}

  void clock(const UnitInputs& inputs, UnitOutputs& out) override {
    unit_->clock(inputs, right_);
    out = right_;
    if (fault_ != nullptr && answers_ >= kFirstFaulty) fault_->spoil(out, waits_);
    waits_ = right_.response_valid && !inputs.response_ready;
    if (right_.response_valid && inputs.response_ready) ++answers_;
  }

  UnitParameters parameters() const override { return unit_->parameters(); }
  uint32_t state_seed() const override { return unit_->state_seed(); }
  uint64_t stopped_clocks() const override { return unit_->stopped_clocks(); }
  bool open_wave(const std::string& path) override { return unit_->open_wave(path); }

 private:
  std::unique_ptr<Unit> unit_;
  const Fault* fault_;
  UnitOutputs right_;
  uint64_t answers_ = 0;
  bool waits_ = false;
};

std::unique_ptr<Unit> make_faulty(const UnitParameters& parameters, const Fault* fault) {
  return std::make_unique<FaultyUnit>(rtl_units().front().make(parameters, nullptr), fault);
}

class BenchTest : public testing::Test {
 protected:
  void SetUp() override {
    if (rtl_units().empty()) GTEST_SKIP() << "SKIP_NO_RTL: Verilator is missing";
  }
};

// Half of the tile records.
FaultyRange some_records(const Bench& bench, const GoldenStream& golden) {
  const SectionEntry& tiles = golden.view().entry(Section::kTile);
  const uint64_t begin = bench.image().stream_base + tiles.offset + tiles.size / 2;
  return {begin, begin + tiles.size / 2, 2};
}

// One run of random blocks, half of them answered with back-pressure; with `bus_errors` some reads
// of records fail.
std::optional<Mismatch> run_with(const Fault* fault, bool bus_errors = false) {
  const UnitParameters parameters = rtl_units().front().parameters;
  const std::vector<uint8_t> bytes = main_stream(parameters.block_size());
  StreamImage image(bytes, parameters);
  Bench& bench = test_bench();
  bench.attach(make_faulty(parameters, fault));
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

TEST_F(BenchTest, TakesBusErrorsOfTheMemory) {
  const auto mismatch = run_with(nullptr, true);
  EXPECT_FALSE(mismatch) << to_string(*mismatch);
  EXPECT_GE(test_bench().scoreboard().counts().unchecked, 10u);
}

TEST_F(BenchTest, CatchesAndNamesEveryFault) {
  for (const Fault& fault : kFaults) {
    const auto mismatch = run_with(&fault);
    ASSERT_TRUE(mismatch) << fault.rule;
    EXPECT_EQ(mismatch->rule.substr(0, std::string_view(fault.rule).size()), fault.rule)
        << to_string(*mismatch);
  }
}

TEST_F(BenchTest, KeepsWhatRepeatsAFailure) {
  const UnitMaker maker{rtl_units().front().parameters, [](const UnitParameters& p, Oracle*) {
                          return make_faulty(p, &kFaults[0]);
                        }};
  const std::vector<uint8_t> bytes = main_stream(maker.parameters.block_size());
  StreamImage image(bytes, maker.parameters);
  RecordedSource recorded(64);
  Bench& bench = test_bench();
  bench.attach(maker.make(maker.parameters, nullptr));
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

}  // namespace
}  // namespace hmlfc::tb
