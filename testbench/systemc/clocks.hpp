// How many clocks the unit takes for blocks of each state, on streams made for it.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "systemc/bench.hpp"
#include "unit/units.hpp"

namespace hmlfc::tb {

/// What was measured of one kind of block.
struct BlockClocks {
  std::string name;
  std::string stream;  ///< what it was measured on
  size_t kind = 0;     ///< of kKindNames in check_report.cpp
  double share = 0;    ///< part of the measured blocks of a level that are of this kind
  double clocks = 0;   ///< for a block of a level, with as many requests as the unit takes
  uint64_t warm = 0;   ///< of a single request whose tiles and strips are kept
  uint64_t cold = 0;   ///< of the first request after a LOAD
};

/// All that is measured, at 20 clocks latency and a beat a clock.
struct ClockTable {
  uint64_t load = 0;  ///< from LOAD to ready
  std::vector<BlockClocks> rows;
};

/// Measures on a fresh unit of `maker`, which must take blocks of 4 and depth 8; `progress` is told
/// the name of each row before it is measured. Whatever differs from the model is in
/// bench.findings().
ClockTable measure_clocks(Bench& bench, const UnitMaker& maker,
                          const std::function<void(const std::string&)>& progress = {});

std::string to_text(const ClockTable& table);
std::string to_json(const ClockTable& table);

/// The table as tlm/latency_table.hpp.
std::string to_header(const ClockTable& table);

}  // namespace hmlfc::tb
