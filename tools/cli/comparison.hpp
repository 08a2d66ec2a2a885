// How near one light field is to another of the same shape.
#pragma once

#include <cstdint>
#include <optional>

#include <hmlfc/decoder.hpp>
#include <hmlfc/light_field.hpp>
#include <hmlfc/measure.hpp>

#include "cli/view_source.hpp"
#include "io/parallel.hpp"

namespace hmlfc::cli {

/// Over the compared pixels; PSNR in dB, infinite where nothing differs.
struct Quality {
  double psnr_rgb = 0;
  double psnr_y = 0;
  uint32_t max_abs_error = 0;
};

/// The quality from the error sums over all pixels of a light field of this shape.
Quality quality_of(const ErrorSums& sums, const LightFieldShape& shape);

/// Decodes all views of `file` on `threads` threads (0: all cores) and sums their differences from
/// `original`, of the same shape. Failure (kCorrupt) as for decoding.
ErrorSums measure_stream(const StreamFile& file, const LightField& original, int threads,
                         const io::Progress& progress);

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

/// What is compared of each light field; all where nothing is set.
struct ComparedPart {
  std::optional<ViewPos> view;
  std::optional<Rect> rect;
};

/// Compares on all cores, with a few views in memory at a time. Failures: the shapes differ
/// (kInput), `part` does not lie in them (kUsage), and those of ViewSource::view.
Comparison compare(const ViewSource& a, const ViewSource& b, const ComparedPart& part,
                   const io::Progress& progress);

}  // namespace hmlfc::cli
