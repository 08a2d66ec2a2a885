#include <memory>
#include <vector>

#include <astcenc.h>

#include "common/timing.hpp"
#include "render/peers.hpp"

namespace hmlfc::bench {
namespace {

constexpr unsigned kBlock = 8;
constexpr astcenc_swizzle kSwizzle{ASTCENC_SWZ_R, ASTCENC_SWZ_G, ASTCENC_SWZ_B, ASTCENC_SWZ_A};

using Context = std::unique_ptr<astcenc_context, decltype(&astcenc_context_free)>;

Context make_context() {
  astcenc_config config;
  astcenc_context* context = nullptr;
  if (astcenc_config_init(ASTCENC_PRF_LDR, kBlock, kBlock, 1, ASTCENC_PRE_FAST, 0, &config) ==
      ASTCENC_SUCCESS) {
    astcenc_context_alloc(&config, 1, &context);
  }
  return Context(context, &astcenc_context_free);
}

}  // namespace

std::optional<Peer> astc_peer(const RgbImage& image) {
  const size_t pixels = size_t{image.width} * image.height;
  std::vector<uint8_t> rgba(pixels * 4, 255);
  for (size_t i = 0; i < image.samples.size(); ++i) {
    rgba[i / 3 * 4 + i % 3] = static_cast<uint8_t>(image.samples[i]);
  }
  void* slice = rgba.data();
  astcenc_image picture{image.width, image.height, 1, ASTCENC_TYPE_U8, &slice};
  const Context context = make_context();
  if (!context) return std::nullopt;
  const size_t blocks =
      size_t{(image.width + kBlock - 1) / kBlock} * ((image.height + kBlock - 1) / kBlock);
  std::vector<uint8_t> bytes(blocks * 16);
  if (astcenc_compress_image(context.get(), &picture, &kSwizzle, bytes.data(), bytes.size(), 0) !=
      ASTCENC_SUCCESS) {
    return std::nullopt;
  }
  const double seconds = cpu_seconds_of([&] {
    astcenc_decompress_reset(context.get());
    astcenc_decompress_image(context.get(), bytes.data(), bytes.size(), &picture, &kSwizzle, 0);
  });
  Peer peer{"ASTC 8x8 (astcenc)", seconds, image};
  for (size_t i = 0; i < image.samples.size(); ++i) {
    peer.decoded.samples[i] = rgba[i / 3 * 4 + i % 3];
  }
  return peer;
}

}  // namespace hmlfc::bench
