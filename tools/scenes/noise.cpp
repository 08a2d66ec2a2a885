// Scene "noise": each sample of each view is independent and uniform, so nothing predicts anything.
#include <cstddef>

#include "scenes/hash_noise.hpp"
#include "scenes/painter.hpp"

namespace hmlfc::scenes {
namespace {

class Noise : public Painter {
 public:
  explicit Noise(const SceneParams& params) : params_(params) {}

  void paint(uint32_t row, uint32_t col, RgbImage& view) const override {
    const uint64_t view_seed = mix_bits(params_.seed) ^ (uint64_t{row} << 12 | col);
    HashStream random(view_seed, 0);
    for (size_t i = 0; i < view.samples.size(); i += 3) {
      const uint64_t bits = random.next();
      for (size_t channel = 0; channel < 3; ++channel) {
        const uint64_t top = bits >> (64 - 16 * (channel + 1)) & 0xFFFFu;
        view.samples[i + channel] = static_cast<uint16_t>(top >> (16 - params_.depth));
      }
    }
  }

 private:
  SceneParams params_;
};

}  // namespace

std::unique_ptr<Painter> make_noise(const SceneParams& params) {
  return std::make_unique<Noise>(params);
}

}  // namespace hmlfc::scenes
