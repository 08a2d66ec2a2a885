#include "render/frame_stages.hpp"

#include <algorithm>
#include <vector>

#include "bits/parallel.hpp"
#include "render/row_kernels.hpp"

namespace hmlfc {
namespace {

constexpr size_t kRowsPerTask = 16;

// Samples rows for one task.
class RowSampler {
 public:
  RowSampler(const FrameRecord& record, int stop_level, const StreamHeader& header,
             const CellDisplacements& displaced, ViewCache& cache)
      : record_(record),
        displaced_(displaced),
        interpolated_(record.filter == static_cast<int32_t>(Filter::kQuadrilinear)),
        views_(cache, header, stop_level),
        rays_(static_cast<size_t>(record.frame_width)),
        taps_(static_cast<size_t>(record.frame_width)),
        samples_(static_cast<size_t>(record.frame_width) * 3 + kRowSpare) {
    pixels_.two_bytes = cache.shape().sample_bytes == 2;
  }

  void sample(int32_t j, uint16_t* out) {
    trace_row(record_, row_of_pixels(record_, j), rays_);
    rays_.displace(displaced_, j);
    int32_t done = 0;
    const auto clear_to = [&](int32_t i) {  // RAY-6
      std::fill(samples_.begin() + 3 * done, samples_.begin() + 3 * i, uint16_t{0});
    };
    for (const RayRun& run : rays_.runs()) {
      clear_to(run.begin);
      sample(run);
      done = run.end;
    }
    clear_to(record_.frame_width);
    std::copy(samples_.begin(), samples_.end() - kRowSpare, out);
  }

 private:
  void sample(const RayRun& run) {
    find_taps(record_, rays_, run, taps_);
    find_weights(record_, rays_, run, taps_);
    size_t count = 0;
    for (int32_t row = run.first_row; row <= run.last_row; ++row) {
      for (int32_t col = run.first_col; col <= run.last_col; ++col) {
        pixels_.rows[count++] = views_.at(row, col).rows();
      }
    }
    sample_run(run, taps_, pixels_, interpolated_, samples_.data() + ptrdiff_t{3} * run.begin);
  }

  const FrameRecord& record_;
  const CellDisplacements& displaced_;
  bool interpolated_;
  ViewLookup views_;
  RowRays rays_;
  RunTaps taps_;
  RunViews pixels_;
  std::vector<uint16_t> samples_;
};

}  // namespace

void sample_frame(const FrameRecord& record, int stop_level, const StreamHeader& header,
                  const CellDisplacements& displaced, ViewCache& cache, RgbImage& image) {
  image.width = static_cast<uint32_t>(record.frame_width);
  image.height = static_cast<uint32_t>(record.frame_height);
  image.depth = header.depth;
  image.samples.resize(size_t{image.width} * image.height * 3);
  const auto rows = static_cast<size_t>(record.frame_height);
  parallel_for_parts(rows, kRowsPerTask, [&](size_t begin, size_t end) {
    RowSampler sampler(record, stop_level, header, displaced, cache);
    for (size_t j = begin; j < end; ++j) {
      sampler.sample(static_cast<int32_t>(j), image.samples.data() + j * image.width * 3);
    }
  });
}

}  // namespace hmlfc
