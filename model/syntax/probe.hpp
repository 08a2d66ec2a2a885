// An optional trace sink and optional counters that watch a decoder.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include <hmlfc/trace.hpp>

namespace hmlfc {

/// Passed down the decode path by value; both pointers may be null.
struct Probe {
  TraceSink* sink = nullptr;
  AccessCounts* counts = nullptr;
  BlockSite site{};

  /// Returns the same watchers for another block.
  Probe at(const BlockSite& other) const { return {sink, counts, other}; }

  void field(Section section, uint64_t bit, unsigned bits, std::string_view name,
             std::string_view clause, int64_t value) const {
    if (counts != nullptr) {
      ++counts->fields;
      counts->bits += bits;
    }
    if (sink != nullptr) sink->on_field({site, section, bit, bits, name, clause, value});
  }

  void stage(std::string_view name, std::string_view clause,
             std::span<const int32_t> values) const {
    if (sink != nullptr) sink->on_stage({site, name, clause, values});
  }

  /// A vector to a place in image (row, col), in eighths of a sample.
  void vector(uint32_t row, uint32_t col, int32_t x, int32_t y, std::string_view clause) const {
    if (sink != nullptr) sink->on_vector({site, row, col, x, y, clause});
  }

  void walk() const {
    if (counts != nullptr) ++counts->walks;
  }

  void step() const {
    if (counts != nullptr) ++counts->steps;
  }
};

}  // namespace hmlfc
