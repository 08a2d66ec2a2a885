// The GPU decoder with the interface of hmlfc_dut.h. HMLFC_GPU_DEVICE names the device, else it is
// the first that can run it.
#include <hmlfc/dut.hpp>
#include <hmlfc/gpu/decoder.hpp>
#include <hmlfc/gpu/renderer.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "decode/block_stages.hpp"
#include "decoder/open_stream.hpp"

using hmlfc::gpu::BlockArea;
using hmlfc::gpu::Device;
using hmlfc::gpu::GpuDecoder;
using hmlfc::gpu::GpuRenderer;
using hmlfc::gpu::LevelStages;

struct hmlfc_dut {
  hmlfc::StreamView stream;
  std::optional<GpuDecoder> decoder;
  std::optional<GpuRenderer> renderer;  // once a frame is asked for
};

namespace {

// A failure of the machine.
int machine_failure(const hmlfc::gpu::Failure& failure) {
  std::fprintf(stderr, "%s\n", failure.message.c_str());
  return HMLFC_DUT_CANNOT_RUN;
}

// Opened once for all streams: it takes as long as to decode a small one.
hmlfc::gpu::Outcome<Device>& the_device() {
  static hmlfc::gpu::Outcome<Device> device = [] {
    hmlfc::gpu::DeviceOptions options;
    if (const char* name = std::getenv("HMLFC_GPU_DEVICE")) options.device = name;
    return Device::open(options);
  }();
  return device;
}

BlockArea one_block(uint32_t row, uint32_t col, uint32_t plane, uint32_t block_x, uint32_t block_y,
                    uint32_t stop_level) {
  BlockArea area;
  area.view = {row, col};
  area.plane = static_cast<hmlfc::Plane>(plane);
  area.bx = block_x;
  area.by = block_y;
  area.stop_level = static_cast<int>(stop_level);
  return area;
}

// The error of a view in which a block failed with `status`: that of the planes in turn (DEC-7).
// Pixels have those of all planes block by block.
int error_of_view(hmlfc_dut& dut, hmlfc::ViewPos view, int status) {
  for (const hmlfc::Plane plane : hmlfc::kPlanes) {
    const hmlfc::PlaneShape& shape = dut.stream.geometry.plane(plane);
    const BlockArea area{view, plane, 0, 0, shape.blocks_x, shape.blocks_y, 0};
    const auto blocks = dut.decoder->decode(std::span(&area, 1));
    if (!blocks) return machine_failure(blocks.error());
    const auto bad = std::ranges::find_if(blocks->statuses, [](uint8_t s) { return s != 0; });
    if (bad != blocks->statuses.end()) return *bad;
  }
  return status;
}

int decode_view(hmlfc_dut& dut, uint32_t row, uint32_t col, uint16_t* rgb) {
  const hmlfc::StreamHeader& header = dut.stream.header;
  const hmlfc::PlaneShape& luma = dut.stream.geometry.plane(hmlfc::Plane::kY);
  const hmlfc::gpu::PixelArea area{{row, col}, 0, 0, luma.blocks_x, luma.blocks_y, 0};
  const auto pixels = dut.decoder->decode_rgb(std::span(&area, 1));
  if (!pixels) return machine_failure(pixels.error());
  const auto bad = std::ranges::find_if(pixels->statuses, [](uint8_t s) { return s != 0; });
  if (bad != pixels->statuses.end()) return error_of_view(dut, {row, col}, *bad);
  const uint32_t b = header.block_size();
  for (uint32_t y = 0; y < header.height; ++y) {
    for (uint32_t x = 0; x < header.width; ++x) {
      const size_t block = size_t{y / b} * luma.blocks_x + x / b;
      for (uint32_t lane = 0; lane < 3; ++lane) {
        const size_t at = ((block * 3 + lane) * b + y % b) * b + x % b;
        *rgb++ = static_cast<uint16_t>(pixels->samples[at]);
      }
    }
  }
  return 0;
}

// Tells the stages of one level, all but the parent (TRC-1).
class StageTeller {
 public:
  StageTeller(const BlockArea& area, const hmlfc::StreamHeader& header, hmlfc_dut_stage_sink sink,
              void* context)
      : area_(area), header_(header), sink_(sink), context_(context) {}

  void tell(const LevelStages& level) const {
    if (level.status != 0) return;
    if (level.references != 0) tell(level.level, "reference", level.reference);
    if (!level.key) tell(level.level, "prediction", level.prediction);
    if (level.has_residual) tell(level.level, "residual", level.residual);
    tell(level.level, "sample", level.sample);
  }

 private:
  void tell(int level, const char* name, const std::vector<int16_t>& values) const {
    uint32_t row = area_.view.row;
    uint32_t col = area_.view.col;
    for (int l = 0; l < level; ++l) {
      row /= header_.cluster_rows;
      col /= header_.cluster_cols;
    }
    const std::vector<int32_t> wide(values.begin(), values.end());
    const hmlfc_dut_stage stage{name,     static_cast<uint32_t>(level),       row,
                                col,      static_cast<uint32_t>(area_.plane), area_.bx,
                                area_.by, static_cast<uint32_t>(wide.size()), wide.data()};
    sink_(context_, &stage);
  }

  const BlockArea& area_;
  const hmlfc::StreamHeader& header_;
  hmlfc_dut_stage_sink sink_;
  void* context_;
};

}  // namespace

uint32_t hmlfc_dut_abi() { return HMLFC_DUT_ABI; }

const char* hmlfc_dut_name() { return "hmlfc GPU decoder"; }

int hmlfc_dut_open(const uint8_t* bytes, size_t size, hmlfc_dut** dut) {
  *dut = nullptr;
  auto stream = hmlfc::open_stream({bytes, size}, {});
  if (!stream) return hmlfc::dut_status(stream.error());
  auto& device = the_device();
  if (!device) return machine_failure(device.error());
  auto opened = std::make_unique<hmlfc_dut>(hmlfc_dut{std::move(*stream), {}, {}});
  auto decoder = GpuDecoder::open(*device, opened->stream);
  if (!decoder) return machine_failure(decoder.error());
  opened->decoder.emplace(std::move(*decoder));
  *dut = opened.release();
  return 0;
}

int hmlfc_dut_get_geometry(const hmlfc_dut* dut, hmlfc_dut_geometry* geometry) {
  *geometry = hmlfc::dut_geometry(dut->stream.header);
  return 0;
}

int hmlfc_dut_decode_view(hmlfc_dut* dut, uint32_t row, uint32_t col, uint16_t* rgb) {
  return decode_view(*dut, row, col, rgb);
}

int hmlfc_dut_decode_block(hmlfc_dut* dut, uint32_t row, uint32_t col, uint32_t plane,
                           uint32_t block_x, uint32_t block_y, uint32_t stop_level,
                           int32_t* samples) {
  const BlockArea area = one_block(row, col, plane, block_x, block_y, stop_level);
  const auto blocks = dut->decoder->decode(std::span(&area, 1));
  if (!blocks) return machine_failure(blocks.error());
  if (blocks->statuses.front() != 0) return blocks->statuses.front();
  std::ranges::copy(blocks->samples, samples);
  return 0;
}

int hmlfc_dut_trace_block(hmlfc_dut* dut, uint32_t row, uint32_t col, uint32_t plane,
                          uint32_t block_x, uint32_t block_y, hmlfc_dut_stage_sink sink,
                          void* context) {
  const BlockArea area = one_block(row, col, plane, block_x, block_y, 0);
  const auto blocks = dut->decoder->trace(std::span(&area, 1));
  if (!blocks) return machine_failure(blocks.error());
  const StageTeller teller(area, dut->stream.header, sink, context);
  for (const LevelStages& level : blocks->front().levels) teller.tell(level);
  return blocks->front().status;
}

int hmlfc_dut_render_frame(hmlfc_dut* dut, const int32_t record[HMLFC_DUT_RECORD_NUMBERS],
                           uint32_t stop_level, uint16_t* rgb, hmlfc_dut_counts* counts) {
  if (!dut->renderer) {
    auto renderer = GpuRenderer::open(*the_device(), dut->stream, 0);
    if (!renderer) return machine_failure(renderer.error());
    dut->renderer.emplace(std::move(*renderer));
  }
  const auto frame =
      dut->renderer->render(hmlfc::frame_record_of(record), static_cast<int>(stop_level));
  if (!frame) return machine_failure(frame.error());
  if (frame->status != hmlfc::ErrorCode::kOk) return static_cast<int>(frame->status);
  std::ranges::copy(frame->image.samples, rgb);
  counts->blocks_needed = static_cast<int64_t>(frame->blocks_needed);
  counts->disparities_looked_up = static_cast<int64_t>(frame->disparities_looked_up);
  return 0;
}

const char* hmlfc_dut_error_name(int status) { return hmlfc::dut_error_name(status); }

void hmlfc_dut_close(hmlfc_dut* dut) { delete dut; }
