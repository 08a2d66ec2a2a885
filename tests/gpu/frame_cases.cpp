#include "gpu/frame_cases.hpp"

#include <utility>

#include <hmlfc/encoder.hpp>

#include "scenes/scene.hpp"

namespace hmlfc::gpu {
namespace {

/// A camera that moves on a little, stays or goes elsewhere.
class Walk {
 public:
  Walk(uint32_t seed, const StreamHeader& header) : random_(seed), header_(header) { jump(); }

  FrameRecord next() {
    const uint32_t step = random_() % 8;
    if (step == 0) jump();
    if (step >= 2) {
      camera_.position->u += 0.3 * between();
      camera_.position->v += 0.3 * between();
    }
    return *frame_record(camera_, header_);
  }

 private:
  double between() { return random_() / 2147483648.0 - 1; }

  void jump() {
    camera_ = test::random_camera(random_, header_);
    camera_.look_at.reset();
    camera_.frame_width = 40;
    camera_.frame_height = 30;
    camera_.geometry = static_cast<GeometrySource>(random_() % 2);
  }

  test::Random random_;
  const StreamHeader& header_;
  Camera camera_;
};

/// A scene in depth; of either profile, by `seed`.
std::vector<uint8_t> scene_stream(uint32_t seed) {
  scenes::SceneParams params;
  params.scene = seed % 4 < 2 ? scenes::Scene::kKnights : scenes::Scene::kCards;
  params.rows = 3;
  params.cols = 4;
  params.width = 72;
  params.height = 56;
  params.baseline_px = 6;
  EncodeParams coding;
  coding.profile = seed % 2 == 0 ? Profile::kExtended : Profile::kMain;
  coding.threads = 1;
  return encode(scenes::render_scene(params, 1), coding)->bytes;
}

/// A camera near the views, with a focal plane somewhere about the scene. Some of its frames are as
/// coarse as far cells, others so fine that a window holds few pixels.
Camera geometry_camera(test::Random& random, const StreamHeader& header) {
  Camera camera = test::random_camera(random, header);
  const auto between = [&](double lo, double hi) {
    return lo + (hi - lo) * random() / 4294967296.0;
  };
  camera.geometry = GeometrySource::kStream;
  camera.aperture = 0;
  camera.shear = 0;
  camera.look_at.reset();
  camera.row_pitch = random() % 3 == 0 ? -1 : 1;
  camera.position->z = random() % 2 == 0 ? 0 : between(-1, 1);
  camera.focus = between(-4, 4);
  camera.tan_half.reset();
  if (random() % 2 == 0) {  // with the pixels of views
    camera.frame_width.reset();
    camera.frame_height.reset();
  }
  return camera;
}

}  // namespace

std::string difference_of_walk(RenderPair& pair, uint32_t seed, int frames, FrameTally& tally) {
  Walk walk(seed, pair.header());
  test::Random random(seed + 1000);
  int stop_level = 0;
  for (int i = 0; i < frames; ++i) {
    const auto levels = static_cast<uint32_t>(pair.header().tree_height) + 1;
    if (random() % 4 == 0) stop_level = static_cast<int>(random() % levels);
    const std::string found = pair.difference(walk.next(), stop_level, tally);
    if (!found.empty()) return "frame " + std::to_string(i) + ": " + found;
  }
  return {};
}

std::string difference_of_scenes(Device& device, uint32_t seeds, tb::Damage damage,
                                 uint64_t cache_bytes, FrameTally& tally) {
  for (uint32_t seed = 0; seed < seeds; ++seed) {
    auto bytes = scene_stream(seed);
    tb::corrupt(bytes, damage, seed);
    RenderPair pair(device, std::move(bytes), cache_bytes);
    if (pair.closed()) continue;
    test::Random random(seed);
    for (int i = 0; i < 12; ++i) {
      const auto record = frame_record(geometry_camera(random, pair.header()), pair.header());
      if (!record) continue;
      const std::string found = pair.difference(*record, 0, tally);
      if (!found.empty()) {
        return "seed " + std::to_string(seed) + ", frame " + std::to_string(i) + ": " + found;
      }
    }
  }
  return {};
}

std::vector<FrameRecord> small_frames(const Decoder& stream) {
  const auto golden = make_golden_renderer(stream);
  std::vector<FrameRecord> records;
  test::Random random(5);
  while (records.size() < 12) {
    Camera camera = test::random_camera(random, stream.header());
    camera.frame_width = 40;
    camera.frame_height = 30;
    camera.geometry = static_cast<GeometrySource>(records.size() % 2);
    const auto record = frame_record(camera, stream.header());
    Frame frame;
    if (!record || !golden->render(*record, 0, frame)) continue;
    if (frame.counts.blocks_needed > 20) records.push_back(*record);
  }
  return records;
}

std::vector<uint8_t> stream_of_many_blocks() {
  EncodeParams params;
  params.profile = Profile::kMain;
  params.block_size = 2;
  params.tree_height = 1;
  params.threads = 1;
  return encode(test::textured_light_field({2, 2, 300, 200, 8}, 1, 4), params)->bytes;
}

}  // namespace hmlfc::gpu
