// Key images decoded ahead of the motion of a camera.
#include "view/ahead.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <hmlfc/stream_info.hpp>

#include "handler_fixture.hpp"

namespace hmlfc::view {
namespace {

using nlohmann::json;

// With those key images decoded, all blocks of a view decode without another one.
TEST(ViewAhead, KeyImagesAreThoseThatAViewReads) {
  for (const uint64_t seed : {2u, 3u, 4u, 5u}) {
    const auto bytes = test::drawn_stream(test::row_of_views(static_cast<int>(seed % 2)), seed);
    for (uint32_t col = 0; col < 6; ++col) {
      OpenStream stream("a.hmlfc", bytes);
      const Decoder& decoder = stream.for_frames().decoder();
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
      stream.touched().reset();
      ASSERT_TRUE(decoder.decode_view({0, col}));
      EXPECT_EQ(stream.touched().key_samples(), 0u) << "view " << col << " needs another one";
    }
  }
}

// What the last of three frames waits for, with and without looking ahead.
TEST(ViewAhead, TheNextKeyImagesAreDecodedAheadOfTheMotion) {
  StreamHeader header = test::row_of_views(0);
  header.cols = 24;
  const auto bytes = test::drawn_stream(header, 7);
  const auto waits = [&bytes](bool ahead, const std::vector<const char*>& cameras) {
    OpenStream stream("a.hmlfc", bytes);
    Handler handler({80, "token"}, stream, nullptr, ahead);
    uint64_t samples = 0;
    for (const char* camera : cameras) {
      const Query query{{"camera", camera}, {"size", "8x6"}, {"geometry", "plane"}};
      const Response response =
          handler.answer({"GET", "/token/frame", query, "127.0.0.1:80", "", ""});
      EXPECT_EQ(response.status, 200) << response.body;
      handler.finish_ahead();
      for (const auto& [name, value] : response.headers) {
        if (name == "Frame") samples = json::parse(value).at("key_samples");
      }
    }
    return samples;
  };
  EXPECT_GT(waits(false, {"12,0", "12.5,0", "15,0"}), 0u);
  EXPECT_EQ(waits(true, {"12,0", "12.5,0", "15,0"}), 0u);
  EXPECT_EQ(waits(true, {"12,0", "11.5,0", "9,0"}), 0u);
  EXPECT_GT(waits(true, {"12,0", "12,0", "15,0"}), 0u) << "nothing is decoded without motion";
  EXPECT_GT(waits(true, {"12,0", "12.5,0", "6,0"}), 0u) << "the other way";
}

}  // namespace
}  // namespace hmlfc::view
