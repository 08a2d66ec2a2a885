#include "camera_case.hpp"

#include <cmath>
#include <optional>
#include <vector>

#include <hmlfc/decoder.hpp>
#include <hmlfc/renderer.hpp>

#include "vectors/field_stream.hpp"
#include "vectors/random.hpp"

namespace hmlfc::stress {
namespace {

using vectors::Random;

constexpr uint64_t kCamerasPerStream = 40;
constexpr uint32_t kMaxSide = 6;  // of a frame

// Light fields small enough for thousands of frames.
std::vector<uint8_t> stream_bytes(uint64_t seed) {
  vectors::Limits limits;
  limits.view_side = 12;
  return vectors::random_stream(seed, limits);
}

class CameraDraw {
 public:
  CameraDraw(Random& random, const StreamHeader& header) : random_(random), header_(header) {}

  Camera draw() {
    camera_.filter = static_cast<Filter>(random_.below(8) == 0 ? random_.below(2) : 2);
    camera_.aperture = static_cast<int>(random_.below(4));
    camera_.frame_width = random_.within(1, kMaxSide);
    camera_.frame_height = random_.within(1, kMaxSide);
    draw_lens();
    draw_place();
    if (one_in(2)) {
      camera_.geometry = GeometrySource::kStream;
      camera_.aperture = 0;
    }
    return camera_;
  }

 private:
  double unit() { return static_cast<double>(random_.below(1u << 30)) / (1u << 30); }
  double between(double lo, double hi) { return lo + (hi - lo) * unit(); }
  bool one_in(unsigned n) { return random_.below(n) == 0; }

  // A magnitude in [2^lo, 2^hi], of either sign.
  double any_size(int lo, int hi) { return (one_in(2) ? 1 : -1) * std::exp2(between(lo, hi)); }

  void draw_lens() {
    if (one_in(2)) camera_.focal = std::exp2(between(0, 16));
    if (one_in(2)) camera_.shear = any_size(-8, 8);
    if (one_in(2)) camera_.focus = any_size(-8, 8);
    if (one_in(4)) camera_.focus = camera_.shear;  // focus at infinity
    if (one_in(4)) camera_.row_pitch = (one_in(2) ? 1 : -1) * between(1.0 / 16, 127.0 / 16);
    if (one_in(2)) camera_.tan_half = std::exp2(between(-10, 1));
    if (one_in(8)) camera_.tan_half = one_in(2) ? 0x1p-10 : 2.0;
  }

  void draw_place() {
    WorldPoint position{between(-0.6, header_.cols - 0.4), between(-0.6, header_.rows - 0.4), 0};
    if (one_in(4)) position.u = std::floor(position.u);
    if (one_in(4)) position.v = std::floor(position.v);
    if (one_in(2)) position.z = any_size(-20, 12);
    if (one_in(16)) position.u = between(-4096, 8192);
    if (one_in(16)) position.v = between(-4096, 8192);
    camera_.position = position;
    if (one_in(2)) return;
    // Towards the grid, so that distant cameras see something; sometimes grazing.
    WorldPoint at{between(0, header_.cols - 1), between(0, header_.rows - 1), 0};
    if (position.z >= 0) at = {2 * position.u - at.u, 2 * position.v - at.v, position.z + 1};
    if (one_in(4)) at = {position.u + any_size(-22, 12), position.v + any_size(-22, 12), at.z};
    camera_.look_at = at;
  }

  Random& random_;
  const StreamHeader& header_;
  Camera camera_;
};

// A light field with its decoder.
struct OpenStream {
  uint64_t seed = 0;
  std::vector<uint8_t> bytes;
  std::optional<Decoder> decoder;
};

// Keeps the decoder of the last stream.
const Decoder& decoder_of(uint64_t seed) {
  static OpenStream open;
  if (!open.decoder || open.seed != seed) {
    open.decoder.reset();
    open.seed = seed;
    open.bytes = stream_bytes(seed);
    open.decoder.emplace(Decoder::open(open.bytes).value());
  }
  return *open.decoder;
}

std::string wrong_record(const FrameRecord& record, const StreamHeader& header) {
  const auto within = [](int64_t x, int64_t most) { return x >= -most && x <= most; };
  const int64_t cols = header.cols;
  const int64_t rows = header.rows;
  const bool good = within(record.gain, 1 << 28) && within(record.x0, 1 << 28) &&
                    within(record.y0, 1 << 28) && within(record.dx * (cols - 1), 1 << 29) &&
                    within(record.dy * (rows - 1), 1 << 29);
  return good ? "" : "a frame record beyond the limits of REC-3";
}

}  // namespace

CameraCase camera_case(uint64_t seed, uint64_t number) {
  CameraCase made;
  made.stream = seed * 1'000'000 + number / kCamerasPerStream;
  Random random(made.stream * kCamerasPerStream + number % kCamerasPerStream);
  made.camera = CameraDraw(random, decoder_of(made.stream).header()).draw();
  return made;
}

CameraCase view_case(uint64_t stream) {
  CameraCase made;
  made.stream = stream;
  made.camera = with_defaults({}, decoder_of(stream).header());
  made.camera.position = {0, 0, 0};
  made.camera.look_at = {0, 0, 1};
  return made;
}

CameraOutcome try_camera(const CameraCase& made) {
  const Decoder& decoder = decoder_of(made.stream);
  const auto record = frame_record(made.camera, decoder.header());
  if (!record) return {true, ""};
  Frame frame;
  const auto drawn = make_golden_renderer(decoder)->render(*record, 0, frame);
  return {false, drawn ? wrong_record(*record, decoder.header())
                       : "no frame: " + to_string(drawn.error())};
}

vectors::Json describe(const CameraCase& made) {
  const Camera& c = made.camera;
  const auto point = [](const std::optional<WorldPoint>& p) {
    return p ? vectors::Json{p->u, p->v, p->z} : vectors::Json();
  };
  const auto number = [](const std::optional<double>& x) {
    return x ? vectors::Json(*x) : vectors::Json();
  };
  return {{"random_stream", made.stream},
          {"frame", {*c.frame_width, *c.frame_height}},
          {"focal", number(c.focal)},
          {"shear", c.shear},
          {"row_pitch", number(c.row_pitch)},
          {"position", point(c.position)},
          {"look_at", point(c.look_at)},
          {"tan_half", number(c.tan_half)},
          {"focus", c.focus},
          {"aperture", c.aperture},
          {"filter", filter_name(c.filter)},
          {"geometry", c.geometry == GeometrySource::kStream ? "stream" : "plane"}};
}

}  // namespace hmlfc::stress
