// How fast units answer: clocks, bytes and latencies of whole runs, every answer compared.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "stimulus/sequences.hpp"
#include "systemc/read_traffic.hpp"
#include "systemc/stream_image.hpp"
#include "unit/dram.hpp"
#include "unit/units.hpp"

namespace hmlfc::tb {

using Json = nlohmann::ordered_json;

/// How much is measured.
struct MeasurementSize {
  uint64_t requests = 4096;  ///< that each unit answers for a row
  uint64_t alone = 64;       ///< requests sent alone
  uint64_t seed = 1;
  std::vector<std::string> only;  ///< rows whose name has one of these, and none alone; empty: all
};

/// What one row of throughput is of.
struct ThroughputRow {
  std::string name;
  ScanPlan plan;
  unsigned latency = 20;  ///< of each unit's own memory, where there is no dram_bus
  size_t units = 1;       ///< each with views and an order of its own
  unsigned dram_bus = 0;  ///< bytes a clock of a Dram that the units share; 0: none
};

/// Measures one stream.
class Measurement {
 public:
  /// At most benches.size() units, made by `maker`. All must outlive it.
  Measurement(const std::vector<std::unique_ptr<Bench>>& benches, const UnitMaker& maker,
              const MeasurementSize& size, std::span<const uint8_t> stream);

  /// {"throughput": rows, "alone": rows}. Nothing where the stream is refused or a unit differs
  /// from the model: finding().
  Json run();

  /// The first difference of a unit from the model, or null.
  const Mismatch* finding() const;

 private:
  RequestSource requests(const ScanPlan& plan, uint64_t count) const;
  void load(size_t unit);
  uint64_t run_units(const ThroughputRow& row, Dram* dram, ReadTraffic& traffic);
  bool throughput(const ThroughputRow& row);
  bool alone();

  const std::vector<std::unique_ptr<Bench>>& benches_;
  const UnitMaker& maker_;
  const MeasurementSize& size_;
  StreamImage image_;
  Json report_;
};

}  // namespace hmlfc::tb
