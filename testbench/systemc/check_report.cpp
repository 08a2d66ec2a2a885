#include "systemc/check_report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hmlfc::tb {
namespace {

constexpr std::array<const char*, kBlockKinds> kKindNames{
    "zero", "motion only", "motion and residual", "residual only", "key image"};

double ratio(double part, double whole) { return whole == 0 ? 0 : part / whole; }

double kind_clocks(const CheckReport& report, size_t kind) {
  return ratio(static_cast<double>(report.counts.kind_clocks[kind]),
               static_cast<double>(report.counts.kind_records[kind]));
}

struct Figures {
  double blocks_per_clock;
  double clocks_per_block;
  double level_blocks_per_clock;
  double bytes_per_block;
  double blocks_per_second;
  double clocks_per_second;
};

Figures figures(const CheckReport& report) {
  const auto blocks = static_cast<double>(report.counts.received);
  const auto clocks = static_cast<double>(report.statistics.clocks);
  return {ratio(blocks, clocks),
          ratio(clocks, blocks),
          ratio(static_cast<double>(report.counts.records), clocks),
          ratio(static_cast<double>(report.statistics.bytes_read), blocks),
          ratio(blocks, report.statistics.seconds),
          ratio(clocks, report.statistics.seconds)};
}

}  // namespace

std::string to_text(const CheckReport& report) {
  const ScoreCounts& c = report.counts;
  const Figures f = figures(report);
  std::string text = fmt::format(
      "{}: {} sent, {} received, {} compared, {} unchecked, {} dropped\n"
      "stages: {} records, {} compared, {} unchecked, {} held chroma, {} missing after errors\n"
      "{} clocks: {:.4f} blocks a clock, {:.2f} clocks a block, {:.3f} level blocks a clock\n"
      "read: {} bytes in {} bursts, {:.1f} bytes a block; {} clocks of answers waiting\n",
      report.unit, c.sent, c.received, c.compared, c.unchecked, c.dropped, c.records,
      c.records_compared, c.records_unchecked, c.records_skipped, c.records_missing,
      report.statistics.clocks, f.blocks_per_clock, f.clocks_per_block, f.level_blocks_per_clock,
      report.statistics.bytes_read, report.memory.bursts, f.bytes_per_block,
      report.stream.answer_stalls);
  for (size_t k = 0; k < kBlockKinds; ++k) {
    text += fmt::format("  {:<20} {:>10} level blocks, {:.2f} clocks each\n", kKindNames[k],
                        c.kind_records[k], kind_clocks(report, k));
  }
  text += fmt::format("simulated: {:.0f} blocks/s, {:.0f} clocks/s in {:.2f} s\n",
                      f.blocks_per_second, f.clocks_per_second, report.statistics.seconds);
  if (report.mismatch) text += "MISMATCH: " + to_string(*report.mismatch) + "\n";
  if (!report.folder.empty()) text += "kept in " + report.folder + "\n";
  if (!report.counts_agree() && !report.mismatch) text += "COUNTS DO NOT AGREE\n";
  text += report.passed() ? "equal to the model\n" : "FAILED\n";
  return text;
}

std::string to_json(const CheckReport& report) {
  const ScoreCounts& c = report.counts;
  const Figures f = figures(report);
  nlohmann::ordered_json json{{"file", report.file},
                              {"unit", report.unit},
                              {"seed", report.seed},
                              {"replay", report.replay},
                              {"passed", report.passed()},
                              {"sent", c.sent},
                              {"received", c.received},
                              {"compared", c.compared},
                              {"unchecked", c.unchecked},
                              {"dropped", c.dropped},
                              {"records", c.records},
                              {"records_compared", c.records_compared},
                              {"records_unchecked", c.records_unchecked},
                              {"records_held", c.records_skipped},
                              {"clocks", report.statistics.clocks},
                              {"blocks_per_clock", f.blocks_per_clock},
                              {"clocks_per_block", f.clocks_per_block},
                              {"level_blocks_per_clock", f.level_blocks_per_clock},
                              {"bytes_read", report.statistics.bytes_read},
                              {"bursts", report.memory.bursts},
                              {"bytes_per_block", f.bytes_per_block},
                              {"answer_stalls", report.stream.answer_stalls},
                              {"seconds", report.statistics.seconds},
                              {"blocks_per_second", f.blocks_per_second},
                              {"clocks_per_second", f.clocks_per_second}};
  for (size_t k = 0; k < kBlockKinds; ++k) {
    json["level_blocks"][kKindNames[k]] = {{"count", c.kind_records[k]},
                                           {"clocks", kind_clocks(report, k)}};
  }
  if (report.mismatch) json["mismatch"] = to_string(*report.mismatch);
  if (!report.folder.empty()) json["folder"] = report.folder;
  return json.dump(2) + "\n";
}

}  // namespace hmlfc::tb
