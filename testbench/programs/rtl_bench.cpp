// rtl-bench: throughput and latency of the decode unit on whole streams.
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "io/files.hpp"
#include "stimulus/sequences.hpp"
#include "systemc/bench.hpp"
#include "systemc/read_traffic.hpp"
#include "systemc/stream_image.hpp"
#include "unit/stand_in.hpp"
#include "unit/units.hpp"

namespace hmlfc::tb {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<unsigned, 5> kLatencies{0, 1, 20, 60, 100};
constexpr std::array<uint64_t, 3> kViews{1, 4, 81};
constexpr unsigned kLatency = 20;  // where only one is measured

constexpr const char* kDescription =
    "Measures how fast the decode unit answers requests for RGB of the STREAMs, whose blocks are "
    "of 4\n"
    "samples; every answer and every stage is compared with the model, and a difference is an "
    "error.\n"
    "  scan    blocks of one view in scan order, by the latency of the memory in clocks\n"
    "  random  each request draws a view of 1, 4 or 81 and a block of it\n"
    "  alone   one request at a time, the first after a LOAD (cold), and the same again (warm)\n"
    "`levels` is blocks of a level a clock, `clocks` and `bytes` are for a request, `busy` is the "
    "share of\n"
    "clocks with a beat of read data. The memory gives a beat of 128 bits a clock. The bytes of a "
    "request\n"
    "are also given by what they are of: entries of ROOT, records of GROUP, records of tiles, "
    "strips of\n"
    "luma and of chroma; `again` are the bytes of beats that had been read before in the row.";

struct Options {
  std::vector<std::string> files;
  uint64_t requests = 4096;
  uint64_t alone = 64;
  uint64_t seed = 1;
  bool json = false;
  bool fault = false;
};

// The first `count` requests of `source`.
RequestSource at_most(uint64_t count, RequestSource source) {
  return [left = count, source = std::move(source)]() mutable -> std::optional<Request> {
    if (left == 0) return std::nullopt;
    --left;
    return source();
  };
}

class Measurement {
 public:
  Measurement(Bench& bench, const UnitMaker& maker, const Options& options, const std::string& path,
              std::span<const uint8_t> bytes)
      : bench_(bench), maker_(maker), options_(options), image_(bytes, maker.parameters) {
    report_["stream"] = std::filesystem::path(path).stem().string();
  }

  // Nothing where the stream is refused or the unit differs from the model: bench.findings().
  Json run() {
    if (image_.golden() == nullptr) return {};
    for (const unsigned latency : kLatencies) {
      const std::string name = fmt::format("scan, latency {}", latency);
      if (!throughput(name, {.seed = options_.seed}, latency)) return {};
    }
    for (const uint64_t views : kViews) {
      const ScanPlan plan{.views = views, .random_order = true, .seed = options_.seed};
      if (!throughput(fmt::format("random, {} views", views), plan, kLatency)) return {};
    }
    return alone() ? report_ : Json{};
  }

 private:
  RequestSource requests(const ScanPlan& plan, uint64_t count) const {
    const GoldenStream& golden = *image_.golden();
    return at_most(count, scan_requests(golden.geometry(), golden.header(), plan));
  }

  void run_requests(RequestSource source, unsigned latency) {
    bench_.begin_counting();
    bench_.run(std::move(source), image_.oracle(), {.latency = latency}, options_.seed);
  }

  // From a unit that has just been made, so that no row depends on the one before.
  bool throughput(const std::string& name, const ScanPlan& plan, unsigned latency) {
    bench_.attach(maker_.make(maker_.parameters));
    image_.load_into(bench_);
    if (bench_.findings().first()) return false;
    ReadTraffic traffic(bench_.image(), image_.golden()->header(), image_.area().layout);
    bench_.memory().set_burst_listener([&](uint64_t address, unsigned beats) {
      traffic.add(address, beats, maker_.parameters.beat_bytes);
    });
    run_requests(requests(plan, options_.requests), latency);
    bench_.memory().set_burst_listener(nullptr);
    if (bench_.findings().first()) return false;
    const auto answers = static_cast<double>(bench_.scoreboard().counts().received);
    const auto records = static_cast<double>(bench_.scoreboard().counts().records);
    const auto clocks = static_cast<double>(bench_.statistics().clocks);
    const auto bytes = static_cast<double>(bench_.statistics().bytes_read);
    report_["throughput"].push_back({{"name", name},
                                     {"levels", records / clocks},
                                     {"clocks", clocks / answers},
                                     {"bytes", bytes / answers},
                                     {"busy", bytes / maker_.parameters.beat_bytes / clocks},
                                     {"traffic", by_part(traffic, answers)}});
    return true;
  }

  static Json by_part(const ReadTraffic& traffic, double answers) {
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

  bool alone() {
    bench_.attach(maker_.make(maker_.parameters));
    const ScanPlan plan{.views = ~uint64_t{0}, .random_order = true, .seed = options_.seed};
    RequestSource source = requests(plan, options_.alone);
    std::vector<uint64_t> cold, warm;
    while (const auto request = source()) {
      image_.load_into(bench_);
      for (auto* clocks : {&cold, &warm}) {
        if (bench_.findings().first()) return false;
        run_requests(listed_requests({*request}), kLatency);
        clocks->push_back(bench_.statistics().clocks);
      }
    }
    add_distribution("cold", std::move(cold));
    add_distribution("warm", std::move(warm));
    return !bench_.findings().first();
  }

  void add_distribution(const char* name, std::vector<uint64_t> clocks) {
    std::ranges::sort(clocks);
    const auto at = [&](size_t percent) { return clocks[(clocks.size() - 1) * percent / 100]; };
    report_["alone"].push_back(
        {{"name", name}, {"p50", at(50)}, {"p99", at(99)}, {"max", at(100)}});
  }

  Bench& bench_;
  const UnitMaker& maker_;
  const Options& options_;
  StreamImage image_;
  Json report_;
};

std::string traffic_text(const Json& rows) {
  std::string text = fmt::format("  {:<26}", "bytes of a request");
  for (const auto& [part, bytes] : rows.at(0).at("traffic").items()) {
    text += fmt::format(" {:>7}", part);
  }
  text += '\n';
  for (const Json& row : rows) {
    text += fmt::format("  {:<26}", row["name"].get<std::string>());
    for (const Json& bytes : row["traffic"]) text += fmt::format(" {:>7.1f}", double{bytes});
    text += '\n';
  }
  return text;
}

std::string to_text(const Json& streams) {
  std::string text;
  for (const Json& stream : streams) {
    text += fmt::format("{:<28} {:>7} {:>8} {:>8} {:>6}\n", stream["stream"].get<std::string>(),
                        "levels", "clocks", "bytes", "busy");
    for (const Json& row : stream["throughput"]) {
      text += fmt::format("  {:<26} {:>7.3f} {:>8.1f} {:>8.1f} {:>5.0f}%\n",
                          row["name"].get<std::string>(), double{row["levels"]},
                          double{row["clocks"]}, double{row["bytes"]}, 100 * double{row["busy"]});
    }
    text += traffic_text(stream["throughput"]);
    text += fmt::format("  {:<26} {:>7} {:>8} {:>8}\n", "alone, latency 20", "p50", "p99", "max");
    for (const Json& row : stream["alone"]) {
      text += fmt::format("  {:<26} {:>7} {:>8} {:>8}\n", row["name"].get<std::string>(),
                          uint64_t{row["p50"]}, uint64_t{row["p99"]}, uint64_t{row["max"]});
    }
  }
  return text;
}

// The Verilated unit, or a stand-in that gives one wrong sample.
std::optional<UnitMaker> choose_unit(const Options& o) {
  if (o.fault) {
    return UnitMaker{
        "stand-in", {2, 12, 16, 16}, [](const UnitParameters& parameters) {
          return std::unique_ptr<DecodeUnit>(std::make_unique<StandIn>(parameters, Fault::kSample));
        }};
  }
  const auto makers = rtl_units();
  const UnitMaker* maker = unit_for(makers, 2, 8);
  return maker == nullptr ? std::nullopt : std::optional(*maker);
}

constexpr int kExitDifferent = 1;
constexpr int kExitUsage = 2;

int usage_error(const std::string& message) {
  fmt::print(stderr, "rtl-bench: {}\n", message);
  return kExitUsage;
}

int run(int argc, char** argv) {
  CLI::App app{kDescription};
  Options o;
  app.add_option("STREAM", o.files, "Streams with blocks of 4")->required();
  app.add_option("--requests", o.requests, "Requests of a row, at most those of a view")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--alone", o.alone, "Requests sent alone")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--seed", o.seed, "Seed of everything random")->capture_default_str();
  app.add_flag("--json", o.json, "Print JSON");
  app.add_flag("--fault", o.fault,
               "Measure a stand-in with a wrong sample, which must be an error");
  CLI11_PARSE(app, argc, argv);
  const auto maker = choose_unit(o);
  if (!maker) return usage_error("this build has no Verilated unit for blocks of 4");
  Bench bench;
  Json streams = Json::array();
  for (const std::string& path : o.files) {
    const auto file = io::MappedFile::open(path);
    if (!file) return usage_error(file.error().message);
    Json report = Measurement(bench, *maker, o, path, file->bytes()).run();
    if (const auto& mismatch = bench.findings().first()) {
      fmt::print(stderr, "rtl-bench: {}: {}\n", path, to_string(*mismatch));
      return kExitDifferent;
    }
    if (report.empty()) return usage_error(path + " is no stream that the unit takes");
    streams.push_back(std::move(report));
  }
  fmt::print("{}", o.json ? streams.dump(2) + "\n" : to_text(streams));
  return 0;
}

}  // namespace
}  // namespace hmlfc::tb

int sc_main(int argc, char** argv) { return hmlfc::tb::run(argc, argv); }
