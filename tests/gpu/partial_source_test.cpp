// Streams of a partial source: the same blocks and frames, a small part held at once, and what is
// left where the source fails.
#include <hmlfc/encoder.hpp>
#include <hmlfc/gpu/renderer.hpp>

#include "decoder/open_stream.hpp"
#include "gpu/gpu_test.hpp"
#include "scenes/scene.hpp"
#include "support/changing_source.hpp"
#include "support/lazy_source.hpp"

namespace hmlfc::gpu {
namespace {

using test::LazySource;

constexpr OpenOptions kUnchecked{.check_sections = false};
constexpr uint64_t kUploadBytes = 256;

// Of `side` x `side` views, with a tree of height `height`.
std::vector<uint8_t> views_of_knights(Profile profile, uint32_t side, int height) {
  scenes::SceneParams params;
  params.scene = scenes::Scene::kKnights;
  params.rows = params.cols = side;
  params.width = 48;
  params.height = 32;
  EncodeParams coding;
  coding.profile = profile;
  coding.tree_height = height;
  return encode(scenes::render_scene(params, 1), coding)->bytes;
}

uint64_t section_bytes(const Decoder& decoder, Section section) {
  return DecoderAccess::stream(decoder).entry(section).size;
}

// Every view.
Outcome<PixelBlocks> pixels_of(GpuDecoder decoder, const StreamView& stream) {
  const PlaneShape& luma = stream.geometry.plane(Plane::kY);
  std::vector<PixelArea> areas;
  for (uint32_t row = 0; row < stream.header.rows; ++row) {
    for (uint32_t col = 0; col < stream.header.cols; ++col) {
      areas.push_back({{row, col}, 0, 0, luma.blocks_x, luma.blocks_y, 0});
    }
  }
  return decoder.decode_rgb(areas);
}

class GpuPartialSource : public GpuTest {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    if (IsSkipped()) return;
    DeviceOptions options;
    options.upload_bytes = kUploadBytes;
    small_ = open(options);
  }

  static FrameRecord record(const StreamHeader& header, GeometrySource geometry) {
    Camera camera;
    camera.position = WorldPoint{1.3, 1.6, 0};
    camera.geometry = geometry;
    return *frame_record(camera, header);
  }

  // The device does what it has to do with a stream in memory.
  void expect_works(const std::vector<uint8_t>& bytes) {
    const auto view = open_stream(bytes, {}).value();
    const auto decoder = GpuDecoder::open(*small_, view);
    ASSERT_TRUE(decoder) << decoder.error().message;
    const auto pixels = pixels_of(*decoder, view);
    ASSERT_TRUE(pixels) << pixels.error().message;
    EXPECT_EQ(pixels->samples, pixels_of(*GpuDecoder::open(device(), view), view)->samples);
  }

  std::optional<Device> small_;  // which uploads in small parts
};

TEST_F(GpuPartialSource, GivesTheSameBlocksAndHoldsLittleAtOnce) {
  for (const Profile profile : {Profile::kMain, Profile::kExtended}) {
    const auto bytes = views_of_knights(profile, 4, 2);
    LazySource source(bytes);
    const auto stream = Decoder::open(source, kUnchecked);
    ASSERT_TRUE(stream);
    source.take_most_held();
    const auto decoder = GpuDecoder::open(*small_, *stream);
    ASSERT_TRUE(decoder) << decoder.error().message;
    // One key image, and the parts of the rest.
    EXPECT_LE(source.take_most_held(), section_bytes(*stream, Section::kTop) + kUploadBytes);
    EXPECT_GT(section_bytes(*stream, Section::kTile), 8 * kUploadBytes);
    const size_t loads = source.loads();
    const StreamView view = open_stream(bytes, {}).value();
    const auto pixels = pixels_of(*decoder, view);
    ASSERT_TRUE(pixels) << pixels.error().message;
    EXPECT_EQ(source.loads(), loads) << "what is on the device is not read again";
    EXPECT_EQ(pixels->samples, pixels_of(*GpuDecoder::open(device(), view), view)->samples);
  }
}

TEST_F(GpuPartialSource, HoldsSomeKeyImagesAtOnce) {
  const auto bytes = views_of_knights(Profile::kMain, 9, 1);
  LazySource source(bytes);
  const auto stream = Decoder::open(source, kUnchecked);
  ASSERT_TRUE(stream);
  ASSERT_GT(DecoderAccess::stream(*stream).geometry.key_count(), 24u);
  source.take_most_held();
  ASSERT_TRUE(GpuDecoder::open(*small_, *stream));
  EXPECT_LT(4 * source.take_most_held(), 3 * section_bytes(*stream, Section::kTop));
}

TEST_F(GpuPartialSource, GivesTheSameFramesAndHoldsARowOfMaps) {
  const auto bytes = views_of_knights(Profile::kExtended, 4, 2);
  LazySource source(bytes);
  const auto stream = Decoder::open(source, kUnchecked);
  ASSERT_TRUE(stream);
  auto renderer = GpuRenderer::open(*small_, *stream, 0);
  auto whole = GpuRenderer::open(device(), open_stream(bytes, {}).value(), 0);
  ASSERT_TRUE(renderer && whole);
  auto other = GpuRenderer::open(*small_, *stream, 0);
  ASSERT_TRUE(other);
  const FrameRecord frame = record(stream->header(), GeometrySource::kStream);
  source.take_most_held();
  source.begin_request();  // which lets it drop nothing
  ASSERT_TRUE(other->render(frame, 0));
  const size_t all = source.take_most_held();
  source.end_request();
  ASSERT_TRUE(renderer->render(record(stream->header(), GeometrySource::kPlane), 0));
  EXPECT_EQ(source.take_most_held(), 0u);
  const auto drawn = renderer->render(frame, 0);
  ASSERT_TRUE(drawn) << drawn.error().message;
  EXPECT_EQ(drawn->status, ErrorCode::kOk);
  EXPECT_EQ(drawn->image.samples, whole->render(frame, 0)->image.samples);
  EXPECT_LT(4 * source.take_most_held(), 3 * all);
}

// From each call of load() on, the last of which is none.
TEST_F(GpuPartialSource, ThatFailsOpensNothingAndLeavesTheDevice) {
  const auto bytes = views_of_knights(Profile::kMain, 3, 1);
  size_t failing = 0;
  LazySource intact(bytes);
  {
    const auto stream = Decoder::open(intact, kUnchecked);
    failing = intact.loads();
    ASSERT_TRUE(GpuDecoder::open(*small_, *stream));
  }
  ASSERT_GT(intact.loads(), failing + 5);
  for (; failing < intact.loads(); ++failing) {
    LazySource source(bytes, failing);
    const auto stream = Decoder::open(source, kUnchecked);
    ASSERT_TRUE(stream);
    const auto decoder = GpuDecoder::open(*small_, *stream);
    ASSERT_FALSE(decoder) << failing;
    EXPECT_EQ(decoder.error().kind, FailureKind::kSource);
    EXPECT_NE(decoder.error().message.find("it was told to fail"), std::string::npos);
  }
  expect_works(bytes);
}

TEST_F(GpuPartialSource, ThatFailsLaterLeavesFramesWithoutGeometry) {
  const auto bytes = views_of_knights(Profile::kExtended, 3, 1);
  size_t failing = 0;
  for (const bool intact : {true, false}) {
    LazySource source(bytes, intact ? LazySource::kNever : failing);
    const auto stream = Decoder::open(source, kUnchecked);
    ASSERT_TRUE(stream);
    auto renderer = GpuRenderer::open(*small_, *stream, uint64_t{1} << 20);
    ASSERT_TRUE(renderer);
    failing = source.loads();
    const auto plain = renderer->render(record(stream->header(), GeometrySource::kPlane), 0);
    ASSERT_TRUE(plain);
    const FrameRecord frame = record(stream->header(), GeometrySource::kStream);
    EXPECT_EQ(renderer->render(frame, 0).has_value(), intact);
    if (intact) continue;
    EXPECT_EQ(renderer->render(frame, 0).error().kind, FailureKind::kSource);
    const auto again = renderer->render(record(stream->header(), GeometrySource::kPlane), 0);
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->image.samples, plain->image.samples);
  }
}

// Whatever is uploaded, blocks and frames end with samples or errors, and the device stays whole.
TEST_F(GpuPartialSource, MayLie) {
  for (const Profile profile : {Profile::kMain, Profile::kExtended}) {
    const auto bytes = views_of_knights(profile, 3, 1);
    for (uint32_t seed = 0; seed < 6; ++seed) {
      test::ChangingSource source(bytes, seed, 1u << seed);
      const auto stream = Decoder::open(source, kUnchecked);
      ASSERT_TRUE(stream);
      source.lie();
      const auto decoder = GpuDecoder::open(*small_, *stream);
      auto renderer = GpuRenderer::open(*small_, *stream, uint64_t{1} << 20);
      ASSERT_TRUE(decoder && renderer);
      EXPECT_TRUE(pixels_of(*decoder, open_stream(bytes, {}).value()));
      EXPECT_TRUE(renderer->render(record(stream->header(), GeometrySource::kStream), 0));
    }
    expect_works(bytes);
  }
}

}  // namespace
}  // namespace hmlfc::gpu
