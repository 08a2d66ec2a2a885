// Two light fields of one shape, compared view by view.
#pragma once

#include <cstdint>
#include <optional>

#include <hmlfc/decoder.hpp>

#include "cli/quality.hpp"
#include "cli/view_source.hpp"
#include "io/parallel.hpp"

namespace hmlfc::cli {

/// One sample that differs.
struct Difference {
  ViewPos view;
  uint32_t x = 0;
  uint32_t y = 0;
  uint32_t channel = 0;  ///< 0 R, 1 G, 2 B
  uint16_t a = 0;
  uint16_t b = 0;
};

/// How two light fields differ.
struct Comparison {
  Quality quality;
  double psnr_rgb_min = 0;                     ///< of the worst view
  ViewPos worst_view;                          ///< the first of them
  std::optional<Difference> first_difference;  ///< views row by row, pixels row by row, R, G, B

  bool identical() const { return !first_difference.has_value(); }
};

/// Compares all views on all cores, a few in memory at a time. Failures: the shapes differ
/// (kInput), and those of ViewSource::view.
Comparison compare(const ViewSource& a, const ViewSource& b, const io::Progress& progress);

}  // namespace hmlfc::cli
