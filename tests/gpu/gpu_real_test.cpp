// The real light fields: every block of Antinous and a random tenth of the blocks of Chess and
// Knights, in both profiles.
#include <hmlfc/decoder.hpp>
#include <hmlfc/encoder.hpp>

#include "decoder/open_stream.hpp"
#include "gpu/gpu_test.hpp"
#include "io/data_folder.hpp"
#include "io/light_field_files.hpp"

namespace hmlfc::gpu {
namespace {

struct RealCase {
  const char* folder;
  Profile profile;
  ChromaFormat chroma;
  unsigned quality;
  double fraction;  // of the blocks, compared in RGB
};

class GpuRealData : public GpuTest, public testing::WithParamInterface<RealCase> {};

// Nothing where the data is missing.
std::optional<std::vector<uint8_t>> encoded(const RealCase& real) {
  const auto folder = real_data(real.folder);
  if (!folder) return std::nullopt;
  const auto views = io::list_views(*folder);
  const auto field = io::load_light_field(*views, 0);
  EncodeParams params;
  params.profile = real.profile;
  params.tree_height = 3;
  params.window = 16;
  params.ref_rows = params.ref_cols = 8;
  params.chroma = real.chroma;
  params.extended.quality = real.quality;
  params.extended.preset = Preset::kFast;
  auto coded = encode(*field, params);
  if (!coded) return std::nullopt;
  return std::move(coded->bytes);
}

// Every block of every plane of every view against the model's planes.
void check_planes(GpuDecoder& decoder, const Decoder& model, const StreamView& stream) {
  const unsigned b = stream.header.block_size();
  for (uint32_t view = 0; view < stream.header.rows * stream.header.cols; ++view) {
    const ViewPos at{view / stream.header.cols, view % stream.header.cols};
    for (const Plane plane : kPlanes) {
      const PlaneShape& shape = stream.geometry.plane(plane);
      const BlockArea area{at, plane, 0, 0, shape.blocks_x, shape.blocks_y, 0};
      const auto blocks = decoder.decode(std::span(&area, 1));
      ASSERT_TRUE(blocks) << blocks.error().message;
      const auto expected = model.decode_plane(at, plane);
      ASSERT_TRUE(expected);
      for (const uint8_t status : blocks->statuses) ASSERT_EQ(status, 0);
      for (uint32_t y = 0; y < shape.height; ++y) {
        for (uint32_t x = 0; x < shape.width; ++x) {
          const size_t block = size_t{y / b} * shape.blocks_x + x / b;
          const size_t i = (block * b + y % b) * b + x % b;
          ASSERT_EQ(blocks->samples[i], (*expected)[size_t{y} * shape.width + x])
              << "view " << at.row << "," << at.col << " plane " << plane_name(plane) << " at " << x
              << "," << y;
        }
      }
    }
  }
}

TEST_P(GpuRealData, IsEqual) {
  const RealCase& real = GetParam();
  const auto bytes = encoded(real);
  if (!bytes) GTEST_SKIP() << real.folder << " is not in HMLFC_DATA_DIR";
  const auto view = open_stream(*bytes, {});
  ASSERT_TRUE(view);
  auto decoder = GpuDecoder::open(device(), *view);
  ASSERT_TRUE(decoder) << decoder.error().message;
  if (real.fraction == 1) {
    const auto model = Decoder::open(*bytes);
    check_planes(*decoder, *model, *view);
    if (HasFatalFailure()) return;
  }
  tb::ScanPlan plan;
  plan.views = ~uint64_t{0};
  plan.fraction = real.fraction == 1 ? 0.02 : real.fraction;
  plan.seed = 1;
  EXPECT_GT(expect_scan_equal(*decoder, *bytes, plan).compared, 20'000u);
}

constexpr const char* kAntinous = "hci-antinous-9x9-512x512";
constexpr const char* kChess = "stanford-chess-16x16-700x400";
constexpr const char* kKnights = "stanford-legoknights-17x17-256x256-jpeg";

INSTANTIATE_TEST_SUITE_P(
    LightFields, GpuRealData,
    testing::Values(RealCase{kAntinous, Profile::kMain, ChromaFormat::k420, 60, 1},
                    RealCase{kAntinous, Profile::kExtended, ChromaFormat::k420, 40, 1},
                    RealCase{kChess, Profile::kMain, ChromaFormat::k420, 66, 0.1},
                    RealCase{kChess, Profile::kExtended, ChromaFormat::k420, 64, 0.1},
                    RealCase{kKnights, Profile::kMain, ChromaFormat::k444, 70, 0.1},
                    RealCase{kKnights, Profile::kExtended, ChromaFormat::k444, 62, 0.1}));

}  // namespace
}  // namespace hmlfc::gpu
