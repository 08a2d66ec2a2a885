// How near decoded views are to the originals.
#pragma once

#include <cstdint>

#include <hmlfc/light_field.hpp>
#include <hmlfc/measure.hpp>

#include "cli/stream_file.hpp"
#include "io/parallel.hpp"

namespace hmlfc::cli {

/// Over all views of a light field; PSNR in dB, infinite where nothing differs.
struct Quality {
  double psnr_rgb = 0;
  double psnr_y = 0;
  uint32_t max_abs_error = 0;
};

/// The quality that `sums` over all views of a light field of this shape mean.
Quality quality_of(const ErrorSums& sums, const LightFieldShape& shape);

/// Decodes all views of `file` on `threads` threads (0: all cores) and adds up how they differ from
/// `original`, of the same shape. Failure (kCorrupt) as for decoding.
ErrorSums measure_stream(const StreamFile& file, const LightField& original, int threads,
                         const io::Progress& progress);

}  // namespace hmlfc::cli
