// bench: throughput and latency of the decode unit on whole streams.
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "io/json_text.hpp"
#include "programs/commands.hpp"
#include "systemc/measurement.hpp"
#include "unit/units.hpp"

namespace hmlfc::tb {
namespace {

constexpr size_t kMostUnits = 4;
constexpr io::JsonLimits kReportLimits{"a report", size_t{1} << 24, 8};

constexpr const char* kDescription =
    R"(Measures how fast the decode unit answers requests for RGB of the STREAMs, whose blocks are of 4
samples; every answer and every stage is compared with the model, and a difference is an error.
  scan    blocks of one view in scan order, by the latency of the memory in clocks
  random  each request draws a view of 1, 4 or 81 and a block of it
  dram    1, 2 and 4 units, each with views of its own, on one DDR-like memory of 16 or 64 bytes a
          clock: lines of 64 bytes, 8 banks with rows of 2 KiB, 20 clocks to a line and 6 more where
          its row has to be opened; random is over 81 views
  alone   one request at a time, the first after a LOAD (cold), and the same again (warm)
`levels` is blocks of a level a clock of all units, `pixels` pixels a clock, `clocks` and `bytes` are for a request, `busy` is
the share of clocks in which the memory's bus carries data, or the lines that they are of, and `row_hits`
in JSON the share of lines whose row was open. A unit takes a beat a clock. The bytes of a request are also given by what they are of: entries of ROOT,
records of GROUP, records of tiles, strips of luma and of chroma; `again` are the bytes of beats that
had been read before in the row.)";

struct Options {
  std::vector<std::string> files;
  MeasurementSize size;
  std::string before;
  bool json = false;
};

std::string traffic_text(const Json& rows) {
  if (rows.empty()) return "";
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
    text +=
        fmt::format("{:<28} {:>7} {:>7} {:>8} {:>8} {:>6}\n", stream["stream"].get<std::string>(),
                    "levels", "pixels", "clocks", "bytes", "busy");
    for (const Json& row : stream["throughput"]) {
      text +=
          fmt::format("  {:<26} {:>7.3f} {:>7.2f} {:>8.1f} {:>8.1f} {:>5.0f}%\n",
                      row["name"].get<std::string>(), double{row["levels"]}, double{row["pixels"]},
                      double{row["clocks"]}, double{row["bytes"]}, 100 * double{row["busy"]});
    }
    text += traffic_text(stream["throughput"]);
    if (stream["alone"].empty()) continue;
    text += fmt::format("  {:<26} {:>7} {:>8} {:>8}\n", "alone, latency 20", "p50", "p99", "max");
    for (const Json& row : stream["alone"]) {
      text += fmt::format("  {:<26} {:>7} {:>8} {:>8}\n", row["name"].get<std::string>(),
                          uint64_t{row["p50"]}, uint64_t{row["p99"]}, uint64_t{row["max"]});
    }
  }
  return text;
}

const Json* row_of(const Json& report, const Json& stream, const Json& name) {
  for (const Json& other : report) {
    if (other.at("stream") != stream) continue;
    for (const Json& row : other.at("throughput")) {
      if (row.at("name") == name) return &row;
    }
  }
  return nullptr;
}

// Clocks of a request of each row that changed by half a percent, against an earlier report.
// Throws Json::exception if `before` is no such report.
std::string changes(const Json& before, const Json& now) {
  std::string text;
  for (const Json& stream : now) {
    for (const Json& row : stream.at("throughput")) {
      const std::string name = fmt::format("{}: {}", stream.at("stream").get<std::string>(),
                                           row.at("name").get<std::string>());
      const Json* old = row_of(before, stream.at("stream"), row.at("name"));
      if (old == nullptr) {
        text += name + ": not in the report before\n";
        continue;
      }
      const double from = old->at("clocks").get<double>();
      const double to = row.at("clocks").get<double>();
      if (std::abs(to / from - 1) < 0.005) continue;
      text += fmt::format("{}: {:.1f} -> {:.1f} clocks ({:+.1f} %)\n", name, from, to,
                          100 * (to / from - 1));
    }
  }
  return text.empty() ? "no row changed by half a percent\n" : text;
}

// The report in file `path`. Throws Stop.
Json report_in(const std::string& path) {
  Json report = io::parse_json<Json>(read_file(path).bytes(), kReportLimits).value_or(Json());
  try {
    changes(report, report);
    if (report.is_array()) return report;
  } catch (const Json::exception&) {
  }
  throw Stop{path + ": not a report of rtl-bench --json"};
}

int run(const Options& o) {
  const auto makers = rtl_units();
  const UnitMaker* maker = unit_for(makers, 2, 8);
  if (maker == nullptr) throw Stop{"this build has no Verilated unit for blocks of 4"};
  const Json before = o.before.empty() ? Json() : report_in(o.before);
  std::vector<std::unique_ptr<Bench>> benches;
  for (size_t i = 0; i < kMostUnits; ++i) {
    benches.push_back(std::make_unique<Bench>(fmt::format("unit{}_", i)));
  }
  Json streams = Json::array();
  for (const std::string& path : o.files) {
    const MappedFile file = read_file(path);
    Measurement measurement(benches, *maker, o.size, file.bytes());
    Json report = measurement.run();
    if (const Mismatch* mismatch = measurement.finding()) {
      throw Stop{path + ": " + to_string(*mismatch), kExitDifferent};
    }
    if (report.empty()) throw Stop{path + " is no stream that the unit takes"};
    report["stream"] = std::filesystem::path(path).stem().string();
    streams.push_back(std::move(report));
  }
  fmt::print("{}", o.json ? streams.dump(2) + "\n" : to_text(streams));
  if (!o.before.empty()) fmt::print(o.json ? stderr : stdout, "{}", changes(before, streams));
  return 0;
}

}  // namespace

Command add_bench(CLI::App& app) {
  auto options = std::make_shared<Options>();
  Options& o = *options;
  app.footer(kDescription);
  app.add_option("STREAM", o.files, "Streams with blocks of 4")->required();
  app.add_option("--requests", o.size.requests,
                 "Requests of a row and unit, at most those of a view")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--alone", o.size.alone, "Requests sent alone")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--seed", o.size.seed, "Seed of everything random")->capture_default_str();
  app.add_option("--only", o.size.only, "Only rows of throughput whose name has one of these")
      ->take_all()
      ->type_name("TEXT");
  app.add_flag("--json", o.json, "Print JSON");
  app.add_option("--compare", o.before,
                 "What --json printed before: also print the rows whose clocks changed");
  return [options] { return run(*options); };
}

}  // namespace hmlfc::tb
