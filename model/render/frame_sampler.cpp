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
             ViewCache& cache)
      : record_(record),
        two_bytes_(cache.shape().sample_bytes == 2),
        interpolated_(record.filter == static_cast<int32_t>(Filter::kQuadrilinear)),
        views_(cache, header, stop_level),
        rays_(static_cast<size_t>(record.frame_width)),
        taps_(static_cast<size_t>(record.frame_width)),
        sums_(static_cast<size_t>(record.frame_width) * 4) {}

  void sample(int32_t j, uint16_t* out) {
    trace_row(record_, j, rays_);
    std::fill(sums_.begin(), sums_.end(), 0u);  // RAY-6
    for_each_run(record_, rays_, [&](const RayRun& run) {
      find_taps(record_, rays_, run, taps_);
      find_weights(record_, rays_, run, taps_);
      for (int32_t row = 0; row < taps_.rows.views; ++row) {
        for (int32_t col = 0; col < taps_.cols.views; ++col) {
          const CachedView& view = views_.at(run.first_row + row, run.first_col + col);
          add_view({view.rows(), two_bytes_}, run, taps_, interpolated_, col, row, sums_.data());
        }
      }
    });
    round_row(sums_.data(), record_.frame_width, out);
  }

 private:
  const FrameRecord& record_;
  bool two_bytes_;
  bool interpolated_;
  ViewLookup views_;
  RowRays rays_;
  RunTaps taps_;
  std::vector<uint32_t> sums_;
};

}  // namespace

void sample_frame(const FrameRecord& record, int stop_level, const StreamHeader& header,
                  ViewCache& cache, RgbImage& image) {
  image.width = static_cast<uint32_t>(record.frame_width);
  image.height = static_cast<uint32_t>(record.frame_height);
  image.depth = header.depth;
  image.samples.resize(size_t{image.width} * image.height * 3);
  const auto rows = static_cast<size_t>(record.frame_height);
  parallel_for_parts(rows, kRowsPerTask, [&](size_t begin, size_t end) {
    RowSampler sampler(record, stop_level, header, cache);
    for (size_t j = begin; j < end; ++j) {
      sampler.sample(static_cast<int32_t>(j), image.samples.data() + j * image.width * 3);
    }
  });
}

}  // namespace hmlfc
