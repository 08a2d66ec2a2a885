// clocks: measures what blocks of each state take.
#include <unistd.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <hmlfc/encoder.hpp>

#include "programs/commands.hpp"
#include "scenes/test_light_fields.hpp"
#include "stimulus/sequences.hpp"
#include "systemc/bench.hpp"
#include "systemc/stream_image.hpp"
#include "unit/units.hpp"

namespace hmlfc::tb {
namespace {

constexpr LightFieldShape kShape{4, 4, 192, 128, 8};
constexpr uint64_t kSeed = 1;

// One row to measure. The cost of a block at level `level` is the difference between requests that
// stop there and requests that stop one level above.
struct Case {
  const char* name;
  const char* stream;  // what it is measured on
  size_t kind;         // of kKindNames in rtl_check.cpp
  unsigned plane;
  unsigned level;
  bool flat;
  uint32_t noise;
  EncodeParams params;
};

// What was measured of a case, at 20 clocks latency and a beat a clock.
struct BlockClocks {
  Case of;
  uint64_t load = 0;  // from LOAD to ready
  double share = 0;   // part of the measured blocks of a level that are of this kind
  double clocks = 0;  // for a block of a level, with as many requests as the unit takes
  uint64_t warm = 0;  // of a single request whose tiles and strips are kept
  uint64_t cold = 0;  // of the first request after a LOAD
};

EncodeParams main_params(int tree_height, uint32_t threshold, Method method = Method::kHmlfc) {
  EncodeParams params;
  params.profile = Profile::kMain;
  params.tree_height = tree_height;
  params.ref_rows = params.ref_cols = 2;
  params.main.threshold_ref = params.main.threshold_pred = threshold;
  params.method = method;
  params.threads = 1;
  return params;
}

EncodeParams extended_params(double quality) {
  EncodeParams params;
  params.window = 16;
  params.chroma = ChromaFormat::k420;
  params.ref_rows = params.ref_cols = 4;
  params.extended.quality = quality;
  params.threads = 1;
  return params;
}

std::vector<Case> cases() {
  const EncodeParams dense = main_params(2, 0, Method::kRlfc);
  const EncodeParams both = main_params(0, 0, Method::kMc);
  const EncodeParams motion = main_params(0, 200, Method::kMc);
  EncodeParams lossless = extended_params(100);
  lossless.lossless = true;
  return {
      {"key image", "main, height 0", 4, 0, 0, false, 0, main_params(0, 0)},
      {"zero", "main, one colour", 0, 0, 0, true, 0, main_params(1, 75)},
      {"residual only, dense", "main without motion, noise", 3, 0, 0, false, 255, dense},
      {"the same, chroma", "main without motion, noise", 3, 1, 0, false, 255, dense},
      {"the same, level 1", "main without motion, noise", 3, 0, 1, false, 255, dense},
      {"motion and residual, explicit vector", "MC, noise", 2, 0, 0, false, 64, both},
      {"motion only, explicit vector", "MC, threshold 200", 1, 0, 0, false, 0, motion},
      {"motion only, shared disparity", "extended, quality 30", 1, 0, 0, false, 0,
       extended_params(30)},
      {"the same, chroma", "extended, quality 30", 1, 1, 0, false, 0, extended_params(30)},
      {"motion and residual, shared disparity", "extended, lossless, noise", 2, 0, 0, false, 8,
       lossless},
  };
}

LightField light_field(const Case& c) {
  if (!c.flat) return test::textured_light_field(kShape, 1, c.noise);
  LightField field(kShape);
  const std::vector<uint16_t> row(size_t{kShape.width} * 3, 100);
  for (uint32_t r = 0; r < kShape.rows; ++r) {
    for (uint32_t v = 0; v < kShape.cols; ++v) {
      for (uint32_t y = 0; y < kShape.height; ++y) field.write_row(r, v, y, row);
    }
  }
  return field;
}

// Runs `source` from counters at 0; the clocks from the first request to the last answer.
uint64_t clocks_of(Bench& bench, StreamImage& image, RequestSource source) {
  bench.begin_counting();
  bench.run(std::move(source), image.oracle(), {}, kSeed);
  return bench.statistics().clocks;
}

class ClockMeasurement {
 public:
  ClockMeasurement(Bench& bench, const Case& c, const UnitMaker& maker)
      : bench_(bench),
        case_(c),
        bytes_(encode(light_field(c), c.params)->bytes),
        image_(bytes_, maker.parameters) {
    bench_.attach(maker.make(maker.parameters, nullptr));
    const uint64_t begin = bench_.cycle();
    image_.load_into(bench_);
    load_ = bench_.cycle() - begin;
  }

  BlockClocks run() {
    BlockClocks row{.of = case_, .load = load_};
    // A view that is no reference image, and a block in its middle.
    const Request lone{1, 1, 20, 12, case_.plane, case_.level, false};
    row.cold = clocks_of(bench_, image_, listed_requests({lone}));
    row.warm = clocks_of(bench_, image_, listed_requests({lone}));
    const auto own = scan(case_.level);
    Scan above;
    if (case_.level < static_cast<unsigned>(image_.golden()->header().tree_height)) {
      above = scan(case_.level + 1);
    }
    const auto kind_records = own.kinds[case_.kind] - above.kinds[case_.kind];
    row.share = static_cast<double>(kind_records) / static_cast<double>(own.requests);
    row.clocks = (static_cast<double>(own.clocks) - static_cast<double>(above.clocks)) /
                 static_cast<double>(own.requests);
    return row;
  }

 private:
  struct Scan {
    uint64_t requests = 0;
    uint64_t clocks = 0;
    std::array<uint64_t, kBlockKinds> kinds{};
  };

  Scan scan(unsigned level) {
    ScanPlan plan;
    plan.views = ~uint64_t{0};
    plan.plane = case_.plane;
    plan.stop_level = level;
    plan.seed = kSeed;
    const GoldenStream& golden = *image_.golden();
    const uint64_t clocks =
        clocks_of(bench_, image_, scan_requests(golden.geometry(), golden.header(), plan));
    return {bench_.scoreboard().counts().received, clocks,
            bench_.scoreboard().counts().kind_records};
  }

  Bench& bench_;
  Case case_;
  std::vector<uint8_t> bytes_;
  StreamImage image_;
  uint64_t load_ = 0;
};

// Measures on fresh units of `maker`, which must take blocks of 4 and depth 8, until one differs
// from the model: bench.findings().
std::vector<BlockClocks> measure_clocks(Bench& bench, const UnitMaker& maker) {
  std::vector<BlockClocks> rows;
  const bool terminal = isatty(STDERR_FILENO) != 0;
  for (const Case& c : cases()) {
    if (terminal) fmt::print(stderr, "\r\033[K{}", c.name);
    ClockMeasurement measurement(bench, c, maker);
    if (!bench.findings().first()) rows.push_back(measurement.run());
    if (bench.findings().first()) break;
  }
  if (terminal) fmt::print(stderr, "\r\033[K");
  return rows;
}

uint64_t load_clocks(const std::vector<BlockClocks>& rows) {
  return std::ranges::max_element(rows, {}, &BlockClocks::load)->load;
}

std::string to_text(const std::vector<BlockClocks>& rows) {
  std::string text =
      fmt::format("LOAD: {} clocks\n{:<38} {:<28} {:>6} {:>7} {:>5} {:>5}\n", load_clocks(rows),
                  "block", "stream", "share", "clocks", "warm", "cold");
  for (const BlockClocks& row : rows) {
    text += fmt::format("{:<38} {:<28} {:>5.0f}% {:>7.2f} {:>5} {:>5}\n", row.of.name,
                        row.of.stream, 100 * row.share, row.clocks, row.warm, row.cold);
  }
  return text;
}

std::string to_json(const std::vector<BlockClocks>& rows) {
  nlohmann::ordered_json json{{"load", load_clocks(rows)}};
  for (const BlockClocks& row : rows) {
    json["blocks"].push_back({{"name", row.of.name},
                              {"stream", row.of.stream},
                              {"share", row.share},
                              {"clocks", row.clocks},
                              {"warm", row.warm},
                              {"cold", row.cold}});
  }
  return json.dump(2) + "\n";
}

struct Options {
  bool json = false;
};

int run(const Options& o) {
  const auto makers = rtl_units();
  const UnitMaker* maker = unit_for(makers, 2, 8);
  if (maker == nullptr) throw Stop{"this build has no Verilated unit for blocks of 4"};
  Bench bench;
  const std::vector<BlockClocks> rows = measure_clocks(bench, *maker);
  if (const auto& mismatch = bench.findings().first()) {
    throw Stop{to_string(*mismatch), kExitDifferent};
  }
  fmt::print("{}", o.json ? to_json(rows) : to_text(rows));
  return 0;
}

}  // namespace

Command add_clocks(CLI::App& app) {
  auto options = std::make_shared<Options>();
  app.add_flag("--json", options->json, "Print JSON");
  return [options] { return run(*options); };
}

}  // namespace hmlfc::tb
