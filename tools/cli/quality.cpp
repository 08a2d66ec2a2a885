#include "cli/quality.hpp"

#include <mutex>

#include "cli/failure.hpp"

namespace hmlfc::cli {

Quality quality_of(const ErrorSums& sums, const LightFieldShape& shape) {
  const uint64_t pixels = uint64_t{shape.rows} * shape.cols * shape.width * shape.height;
  return {psnr(sums.rgb_squares, pixels * 3, shape.depth),
          psnr(sums.y_squares, pixels, shape.depth), sums.max_abs};
}

ErrorSums measure_stream(const StreamFile& file, const LightField& original, int threads,
                         const io::Progress& progress) {
  const size_t count = size_t{original.shape().rows} * original.shape().cols;
  std::mutex mutex;
  ErrorSums sums;
  size_t done = 0;
  const auto add_view = [&](ViewPos at, RgbImage&& decoded) {
    const ErrorSums error = measure(original.view(at.row, at.col), decoded);
    const std::scoped_lock lock(mutex);
    sums.add(error);
    if (progress) progress(++done, count);
  };
  value_or_throw(file.decoder().decode_all(add_view, {.threads = threads}), file.path());
  return sums;
}

}  // namespace hmlfc::cli
