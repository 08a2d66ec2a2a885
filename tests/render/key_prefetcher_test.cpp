// Key images decoded ahead of the motion of a camera.
#include <hmlfc/key_prefetcher.hpp>

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include <hmlfc/renderer.hpp>
#include <hmlfc/stream_info.hpp>

#include "render/key_images_of.hpp"
#include "render/render_cases.hpp"
#include "support/streams.hpp"

namespace hmlfc {
namespace {

// Counts the samples of key images that frames wait for.
class Waits final : public ReadSink {
 public:
  void on_read(uint64_t, uint64_t) override {}
  void on_key_plane(uint64_t samples) override {
    if (!KeyPrefetcher::is_this_thread()) samples_ += samples;
  }
  uint64_t take() { return samples_.exchange(0); }

 private:
  std::atomic<uint64_t> samples_ = 0;
};

// With those key images decoded, all blocks of a view decode without another one.
TEST(KeyPrefetcher, KeyImagesAreThoseThatAViewReads) {
  for (const uint64_t seed : {2u, 3u, 4u, 5u}) {
    const auto bytes = test::drawn_stream(test::row_of_views(static_cast<int>(seed % 2)), seed);
    for (uint32_t col = 0; col < 6; ++col) {
      Waits waits;
      const test::OpenedStream stream(bytes, {.reads = &waits});
      const Decoder& decoder = *stream.decoder;
      const StreamHeader& header = decoder.header();
      const auto keys = key_images_of(header, {0, col}, 0);
      EXPECT_FALSE(keys.empty());
      for (const KeyImage& key : keys) {
        EXPECT_EQ(image_info(header, key.level, key.row, key.col).kind, ImageKind::kKey);
        const uint32_t first = key.level == 0 ? key.col : key.col * header.cluster_cols;
        for (const Plane plane : kPlanes) {
          ASSERT_TRUE(decoder.decode_plane({0, first}, plane, key.level));
        }
      }
      EXPECT_GT(waits.take(), 0u);
      ASSERT_TRUE(decoder.decode_view({0, col}));
      EXPECT_EQ(waits.take(), 0u) << "view " << col << " needs another one";
    }
  }
}

// A row of 24 views, and a camera that stands at one column after another.
class MovingCamera {
 public:
  MovingCamera() {
    StreamHeader header = test::row_of_views(0);
    header.cols = 24;
    bytes_ = test::drawn_stream(header, 7);
  }

  // Returns the samples that the last of these frames waits for; opens the stream anew.
  uint64_t last_waits(bool ahead, const std::vector<double>& columns, int stop_level = 0) const {
    Waits waits;
    const test::OpenedStream stream(bytes_, {.reads = &waits});
    const auto renderer = make_cpu_renderer(*stream.decoder);
    KeyPrefetcher prefetcher(*stream.decoder);
    uint64_t samples = 0;
    for (const double column : columns) {
      const FrameRecord record = record_at(stream.decoder->header(), column);
      Frame frame;
      EXPECT_TRUE(renderer->render(record, 0, frame));
      samples = waits.take();
      if (ahead) prefetcher.rendered(record, stop_level);
      prefetcher.finish();
    }
    return samples;
  }

 private:
  static FrameRecord record_at(const StreamHeader& header, double column) {
    Camera camera;
    camera.frame_width = 8;
    camera.frame_height = 6;
    camera.position = WorldPoint{column, 0, 0};
    return frame_record(camera, header).value();
  }

  std::vector<uint8_t> bytes_;
};

TEST(KeyPrefetcher, TheNextKeyImagesAreDecodedAheadOfTheMotion) {
  const MovingCamera camera;
  EXPECT_GT(camera.last_waits(false, {12, 12.5, 15}), 0u);
  EXPECT_EQ(camera.last_waits(true, {12, 12.5, 15}), 0u);
  EXPECT_EQ(camera.last_waits(true, {12, 11.5, 9}), 0u);
  EXPECT_GT(camera.last_waits(true, {12, 12, 15}), 0u) << "nothing is decoded without motion";
  EXPECT_GT(camera.last_waits(true, {12, 12.5, 6}), 0u) << "the other way";
  EXPECT_GT(camera.last_waits(true, {12, 12.5, 15}, 9), 0u) << "no such stop level";
}

// Destroyed while it decodes, it waits for one plane and leaves a decoder that works.
TEST(KeyPrefetcher, EndsWhileItDecodes) {
  const test::OpenedStream stream(test::drawn_stream(test::row_of_views(0), 7));
  const auto at = [&](double column) {
    Camera camera;
    camera.position = WorldPoint{column, 0, 0};
    return frame_record(camera, stream.decoder->header()).value();
  };
  {
    KeyPrefetcher prefetcher(*stream.decoder);
    prefetcher.rendered(at(0), 0);
    prefetcher.rendered(at(1), 0);
  }
  EXPECT_TRUE(stream.decoder->decode_view({0, 5}));
}

}  // namespace
}  // namespace hmlfc
