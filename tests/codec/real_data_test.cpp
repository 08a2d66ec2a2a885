// The real light fields: encode, decode, and the recorded quality.
#include <gtest/gtest.h>

#include <sys/resource.h>

#include <mutex>

#include <hmlfc/decoder.hpp>
#include <hmlfc/encoder.hpp>

#include "io/data_folder.hpp"
#include "io/light_field_files.hpp"

namespace hmlfc {
namespace {

// Recorded with `hmlfc encode FOLDER --profile main`, which measures the
// decoded file; a change of format or encoder that moves these must say why.
struct Record {
  const char* folder;
  uint32_t rows;
  uint32_t cols;
  double psnr_rgb;
  double psnr_y;
  double bpp;
};

constexpr Record kRecords[] = {
    {"stanford-chess-16x16-700x400", 16, 16, 38.206, 39.394, 0.5713},
    {"hci-antinous-9x9-512x512", 9, 9, 39.601, 40.175, 0.4188},
    {"stanford-legoknights-17x17-256x256-jpeg", 17, 17, 34.983, 36.883, 1.8225},
};

// Largest resident size of this process so far, in bytes.
uint64_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<uint64_t>(usage.ru_maxrss) * 1024;
}

class RealData : public ::testing::TestWithParam<Record> {};

TEST_P(RealData, EncodesDecodesAndMatchesTheRecord) {
  const Record& record = GetParam();
  const auto folder = real_data(record.folder);
  if (!folder) GTEST_SKIP() << record.folder << " is not in HMLFC_DATA_DIR";
  const auto views = io::list_views(*folder);
  ASSERT_TRUE(views.has_value()) << views.error().message;
  EXPECT_EQ(views->rows, record.rows);
  EXPECT_EQ(views->cols, record.cols);
  const auto field = io::load_light_field(*views, 0);
  ASSERT_TRUE(field.has_value()) << field.error().message;

  const auto encoded = encode(*field, {.profile = Profile::kMain});
  ASSERT_TRUE(encoded.has_value()) << encoded.error().message;
  const LightFieldShape& shape = field->shape();
  const uint64_t pixels = uint64_t{shape.rows} * shape.cols * shape.width * shape.height;
  EXPECT_LE(peak_memory(), 3 * pixels * 3 + (uint64_t{256} << 20));

  const auto decoder = Decoder::open(encoded->bytes);
  ASSERT_TRUE(decoder.has_value()) << to_string(decoder.error());
  ErrorSums sums;
  std::mutex mutex;
  const auto done = decoder->decode_all([&](ViewPos view, RgbImage&& image) {
    const ErrorSums error = measure(field->view(view.row, view.col), image);
    const std::scoped_lock lock(mutex);
    sums.add(error);
  });
  ASSERT_TRUE(done.has_value()) << to_string(done.error());
  EXPECT_EQ(sums.rgb_squares, encoded->error.rgb_squares);
  EXPECT_EQ(sums.y_squares, encoded->error.y_squares);

  const double bpp = 8.0 * static_cast<double>(encoded->bytes.size()) / static_cast<double>(pixels);
  EXPECT_NEAR(psnr(sums.rgb_squares, pixels * 3, shape.depth), record.psnr_rgb, 0.005);
  EXPECT_NEAR(psnr(sums.y_squares, pixels, shape.depth), record.psnr_y, 0.005);
  EXPECT_NEAR(bpp, record.bpp, 0.0005);
}

INSTANTIATE_TEST_SUITE_P(LightFields, RealData, ::testing::ValuesIn(kRecords));

}  // namespace
}  // namespace hmlfc
