#include "accuracy/frame_backend.hpp"

#include <memory>
#include <utility>

#include "decoder/open_stream.hpp"
#include "gpu_ref/device.hpp"
#include "gpu_ref/gpu_renderer.hpp"

namespace hmlfc::bench {
namespace {

DrawFrame draw_with(std::unique_ptr<FrameRenderer> made) {
  const std::shared_ptr<FrameRenderer> renderer = std::move(made);
  return [renderer](const FrameRecord& record, int stop_level,
                    Frame& frame) -> tl::expected<void, std::string> {
    const auto done = renderer->render(record, stop_level, frame);
    if (!done) return tl::unexpected(to_string(done.error()));
    return {};
  };
}

struct GpuState {
  explicit GpuState(gpu::Device opened) : device(std::move(opened)) {}

  gpu::Device device;
  std::optional<gpu::GpuRenderer> renderer;
};

tl::expected<DrawFrame, std::string> open_gpu(std::span<const uint8_t> file, size_t cache_bytes) {
  auto device = gpu::Device::open();
  if (!device) return tl::unexpected(device.error().message);
  const auto stream = open_stream(file, {});
  if (!stream) return tl::unexpected(to_string(stream.error()));
  const auto state = std::make_shared<GpuState>(std::move(*device));
  auto renderer = gpu::GpuRenderer::open(state->device, *stream, cache_bytes);
  if (!renderer) return tl::unexpected(renderer.error().message);
  state->renderer = std::move(*renderer);
  return [state](const FrameRecord& record, int stop_level,
                 Frame& frame) -> tl::expected<void, std::string> {
    auto drawn = state->renderer->render(record, stop_level);
    if (!drawn) return tl::unexpected(drawn.error().message);
    if (drawn->status != ErrorCode::kOk) {
      return tl::unexpected(std::string(error_name(drawn->status)));
    }
    frame.image = std::move(drawn->image);
    frame.counts = {drawn->blocks_needed, drawn->blocks_decoded,
                    drawn->blocks_needed - drawn->blocks_decoded, 0};
    return {};
  };
}

}  // namespace

tl::expected<DrawFrame, std::string> open_backend(const FrameSetting& setting,
                                                  std::span<const uint8_t> file,
                                                  const Decoder& decoder) {
  const size_t cache_bytes = setting.cache_mib << 20;
  switch (setting.backend) {
    case Backend::kGpu:
      return open_gpu(file, cache_bytes);
    case Backend::kGolden:
      return draw_with(make_golden_renderer(decoder));
    case Backend::kCpu:
      break;
  }
  RenderOptions options;
  options.cache_bytes = cache_bytes;
  return draw_with(make_cpu_renderer(decoder, options));
}

}  // namespace hmlfc::bench
