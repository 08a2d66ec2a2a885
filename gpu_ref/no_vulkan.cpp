// Stands for the decoder in builds without the Vulkan headers or the shader compiler.
#include <hmlfc/gpu/decoder.hpp>
#include <hmlfc/gpu/reference_area.hpp>
#include <hmlfc/gpu/renderer.hpp>

#include "decode/block_stages.hpp"

namespace hmlfc::gpu {
namespace {

tl::unexpected<Failure> missing() {
  return tl::unexpected(
      Failure{FailureKind::kUnusable,
              "this build has no GPU decoder: the Vulkan headers or glslc were missing (Debian: "
              "libvulkan-dev glslc)"});
}

}  // namespace

struct Device::State {
  DeviceInfo info;
  std::vector<std::string> messages;
  SubmissionCounts counts;
};

Outcome<std::vector<DeviceInfo>> list_devices() { return missing(); }

Outcome<Device> Device::open(const DeviceOptions&) { return missing(); }
const DeviceInfo& Device::info() const { return state_->info; }
const SubmissionCounts& Device::counts() const { return state_->counts; }
const std::vector<std::string>& Device::validation_messages() const { return state_->messages; }

struct GpuDecoder::State {
  std::vector<StageTime> times;
};

Outcome<GpuDecoder> GpuDecoder::open(Device&, const StreamView&) { return missing(); }
Outcome<GpuDecoder> GpuDecoder::open(Device&, const Decoder&) { return missing(); }
Outcome<Blocks> GpuDecoder::decode(std::span<const BlockArea>) { return missing(); }
Outcome<PixelBlocks> GpuDecoder::decode_rgb(std::span<const PixelArea>) { return missing(); }
Outcome<std::vector<BlockStages>> GpuDecoder::trace(std::span<const BlockArea>) {
  return missing();
}
const std::vector<StageTime>& GpuDecoder::stage_times() const { return state_->times; }
uint64_t GpuDecoder::reference_bytes() const { return 0; }
void GpuDecoder::limit_submissions(uint64_t) {}

Outcome<std::vector<uint8_t>> reference_area(const StreamView&) { return missing(); }
Outcome<std::vector<uint8_t>> reference_area(const Decoder&) { return missing(); }

struct GpuRenderer::State {
  std::vector<StageTime> times;
};

Outcome<GpuRenderer> GpuRenderer::open(Device&, const StreamView&, uint64_t) { return missing(); }
Outcome<GpuRenderer> GpuRenderer::open(Device&, const Decoder&, uint64_t) { return missing(); }
Outcome<GpuFrame> GpuRenderer::render(const FrameRecord&, int) { return missing(); }
Outcome<void> GpuRenderer::begin(const FrameRecord&, int, FrameOutput) { return missing(); }
unsigned GpuRenderer::most_under_way() { return 0; }
unsigned GpuRenderer::under_way() const { return 0; }
Outcome<bool> GpuRenderer::ready() { return missing(); }
Outcome<void> GpuRenderer::finish(GpuFrame&) { return missing(); }
uint64_t GpuRenderer::picture_address() const { return 0; }
void GpuRenderer::forget() {}
const std::vector<StageTime>& GpuRenderer::stage_times() const { return state_->times; }

}  // namespace hmlfc::gpu
