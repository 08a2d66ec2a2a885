#include "accuracy/frame_backend.hpp"

#include <utility>

#include "gpu_ref/frame_renderer.hpp"

namespace hmlfc::bench {

tl::expected<std::unique_ptr<FrameRenderer>, std::string> open_backend(const FrameSetting& setting,
                                                                       const Decoder& decoder) {
  RenderOptions options;
  options.cache_bytes = setting.cache_mib << 20;
  if (setting.backend == Backend::kCpu) return make_cpu_renderer(decoder, options);
  if (setting.backend == Backend::kGolden) return make_golden_renderer(decoder);
  auto device = gpu::Device::open();
  if (!device) return tl::unexpected(device.error().message);
  auto renderer = gpu::make_gpu_renderer(std::move(*device), decoder, options);
  if (!renderer) return tl::unexpected(renderer.error().message);
  return std::move(*renderer);
}

}  // namespace hmlfc::bench
