#include "gpu_frame_renderer.hpp"

#include <chrono>
#include <optional>
#include <utility>

#include <hmlfc/gpu/renderer.hpp>

#include "decoder/open_stream.hpp"

namespace hmlfc::gpu {
namespace {

class GpuFrameRenderer final : public FrameRenderer {
 public:
  explicit GpuFrameRenderer(Device device) : device_(std::move(device)) {}

  Outcome<void> open(const StreamView& stream, uint64_t cache_bytes) {
    auto renderer = GpuRenderer::open(device_, stream, cache_bytes);
    if (!renderer) return tl::unexpected(std::move(renderer.error()));
    renderer_ = std::move(*renderer);
    return {};
  }

  Result<void> render(const FrameRecord& record, int stop_level, Frame& frame) override {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    auto drawn = renderer_->render(record, stop_level);
    if (!drawn) throw DeviceError(drawn.error().message);
    if (drawn->status != ErrorCode::kOk) return fail(drawn->status, Section::kTile, 0);
    frame.image = std::move(drawn->image);
    frame.counts = {drawn->blocks_needed, drawn->blocks_decoded,
                    drawn->blocks_needed - drawn->blocks_decoded, 0, drawn->disparities_looked_up};
    frame.seconds = {0, 0, std::chrono::duration<double>(Clock::now() - begin).count()};
    return {};
  }

 private:
  Device device_;
  std::optional<GpuRenderer> renderer_;
};

}  // namespace

Outcome<std::unique_ptr<FrameRenderer>> make_gpu_renderer(Device device, const Decoder& decoder,
                                                          const RenderOptions& options) {
  auto renderer = std::make_unique<GpuFrameRenderer>(std::move(device));
  const auto opened = renderer->open(DecoderAccess::stream(decoder), options.cache_bytes);
  if (!opened) return tl::unexpected(opened.error());
  return renderer;
}

}  // namespace hmlfc::gpu
