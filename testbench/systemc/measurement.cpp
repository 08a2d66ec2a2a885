#include "systemc/measurement.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace hmlfc::tb {
namespace {

constexpr std::array<unsigned, 5> kLatencies{0, 1, 20, 60, 100};
constexpr std::array<uint64_t, 3> kViews{1, 4, 81};
constexpr std::array<size_t, 3> kUnits{1, 2, 4};
constexpr uint64_t kLookClocks = 64;  // clocks between looks at whether a run is over
constexpr unsigned kLatency = 20;     // where only one is measured
constexpr unsigned kNarrowDram = 16;  // bytes a clock: as much as the port of one unit
constexpr unsigned kWideDram = 64;    // as the ports of four

// The first `count` requests of `source`.
RequestSource at_most(uint64_t count, RequestSource source) {
  return [left = count, source = std::move(source)]() mutable -> std::optional<Request> {
    if (left == 0) return std::nullopt;
    --left;
    return source();
  };
}

bool is_asked(const MeasurementSize& size, const std::string& name) {
  return size.only.empty() || std::ranges::any_of(size.only, [&](const std::string& part) {
           return name.find(part) != std::string::npos;
         });
}

std::vector<ThroughputRow> all_rows(size_t most_units) {
  std::vector<ThroughputRow> rows;
  for (const unsigned latency : kLatencies) {
    rows.push_back({fmt::format("scan, latency {}", latency), {}, latency});
  }
  for (const uint64_t views : kViews) {
    rows.push_back(
        {fmt::format("random, {} views", views), {.views = views, .random_order = true}});
  }
  const ScanPlan all_views{.views = kViews.back(), .random_order = true};
  for (const unsigned bus : {kNarrowDram, kWideDram}) {
    for (const size_t units : kUnits) {
      if (units > most_units) continue;
      const std::string where = fmt::format("dram {}, {} units", bus, units);
      rows.push_back({"scan, " + where, {}, kLatency, units, bus});
      rows.push_back({"random, " + where, all_views, kLatency, units, bus});
    }
  }
  return rows;
}

Json by_part(const ReadTraffic& traffic, double answers) {
  Json parts;
  uint64_t again = 0;
  for (size_t i = 0; i < kReadPartNames.size(); ++i) {
    const PartTraffic& part = traffic.of(static_cast<ReadPart>(i));
    parts[std::string(kReadPartNames[i])] = static_cast<double>(part.bytes) / answers;
    again += part.again;
  }
  parts["again"] = static_cast<double>(again) / answers;
  return parts;
}

Json distribution(const char* name, std::vector<uint64_t> clocks) {
  std::ranges::sort(clocks);
  const auto at = [&](size_t percent) { return clocks[(clocks.size() - 1) * percent / 100]; };
  return {{"name", name}, {"p50", at(50)}, {"p99", at(99)}, {"max", at(100)}};
}

}  // namespace

Measurement::Measurement(const std::vector<std::unique_ptr<Bench>>& benches, const UnitMaker& maker,
                         const MeasurementSize& size, std::span<const uint8_t> stream)
    : benches_(benches), maker_(maker), size_(size), image_(stream, maker.parameters) {}

Json Measurement::run() {
  if (image_.golden() == nullptr) return {};
  report_ = {{"throughput", Json::array()}, {"alone", Json::array()}};
  for (const ThroughputRow& row : all_rows(benches_.size())) {
    if (is_asked(size_, row.name) && !throughput(row)) return {};
  }
  return !size_.only.empty() || alone() ? report_ : Json{};
}

const Mismatch* Measurement::finding() const {
  for (const auto& bench : benches_) {
    if (const auto& mismatch = bench->findings().first()) return &*mismatch;
  }
  return nullptr;
}

RequestSource Measurement::requests(const ScanPlan& plan, uint64_t count) const {
  const GoldenStream& golden = *image_.golden();
  return at_most(count, scan_requests(golden.geometry(), golden.header(), plan));
}

// A unit that has just been made, so that no row depends on the one before.
void Measurement::load(size_t unit) {
  Bench& bench = *benches_[unit];
  bench.attach(maker_.make(maker_.parameters, nullptr));
  image_.load_into(bench);
  bench.begin_counting();
}

// Starts `row.units` units, runs them until none is busy, and gives the clocks until the last
// answer.
uint64_t Measurement::run_units(const ThroughputRow& row, Dram* dram, ReadTraffic& traffic) {
  const std::span units(benches_.data(), row.units);
  const unsigned beat_bytes = maker_.parameters.beat_bytes;
  for (size_t i = 0; i < units.size(); ++i) {
    AxiMemory& memory = units[i]->memory();
    memory.set_dram(dram);
    memory.set_burst_listener([&traffic, beat_bytes](uint64_t address, unsigned beats) {
      traffic.add(address, beats, beat_bytes);
    });
    ScanPlan plan = row.plan;
    plan.seed = size_.seed + i;
    units[i]->start(requests(plan, size_.requests), image_.oracle(), {.latency = row.latency},
                    plan.seed);
  }
  const uint64_t begin = units[0]->cycle();
  while (std::ranges::any_of(units, [](const auto& bench) { return bench->busy(); })) {
    units[0]->run_clocks(kLookClocks);
  }
  uint64_t end = begin;
  for (const auto& bench : units) {
    end = std::max(end, bench->stream_counts().last_answer);
    bench->finish();
    bench->memory().set_dram(nullptr);
    bench->memory().set_burst_listener(nullptr);
  }
  return end - begin;
}

bool Measurement::throughput(const ThroughputRow& row) {
  for (size_t i = 0; i < row.units; ++i) load(i);
  if (finding() != nullptr) return false;
  std::optional<Dram> dram;
  if (row.dram_bus != 0) dram.emplace(row.dram_bus);
  ReadTraffic traffic(benches_[0]->image(), image_.golden()->header(), image_.area().layout);
  const auto clocks = static_cast<double>(run_units(row, dram ? &*dram : nullptr, traffic));
  if (finding() != nullptr) return false;
  double answers = 0, records = 0, bytes = 0;
  for (const auto& bench : std::span(benches_.data(), row.units)) {
    answers += static_cast<double>(bench->scoreboard().counts().received);
    records += static_cast<double>(bench->scoreboard().counts().records);
    bytes += static_cast<double>(bench->statistics().bytes_read);
  }
  const double bus_clocks =
      dram ? static_cast<double>(dram->busy_clocks()) : bytes / maker_.parameters.beat_bytes;
  Json result{{"name", row.name},
              {"levels", records / clocks},
              {"pixels",
               answers * maker_.parameters.block_size() * maker_.parameters.block_size() / clocks},
              {"clocks", clocks / answers},
              {"bytes", bytes / answers},
              {"busy", bus_clocks / clocks}};
  if (dram) {
    result["row_hits"] =
        1 - static_cast<double>(dram->rows_opened()) / static_cast<double>(dram->lines());
  }
  result["traffic"] = by_part(traffic, answers);
  report_["throughput"].push_back(std::move(result));
  return true;
}

bool Measurement::alone() {
  Bench& bench = *benches_[0];
  bench.attach(maker_.make(maker_.parameters, nullptr));
  const ScanPlan plan{.views = ~uint64_t{0}, .random_order = true, .seed = size_.seed};
  RequestSource source = requests(plan, size_.alone);
  std::vector<uint64_t> cold, warm;
  while (const auto request = source()) {
    image_.load_into(bench);
    for (auto* clocks : {&cold, &warm}) {
      if (finding() != nullptr) return false;
      bench.begin_counting();
      bench.run(listed_requests({*request}), image_.oracle(), {.latency = kLatency}, size_.seed);
      clocks->push_back(bench.statistics().clocks);
    }
  }
  report_["alone"] = {distribution("cold", std::move(cold)), distribution("warm", std::move(warm))};
  return finding() == nullptr;
}

}  // namespace hmlfc::tb
