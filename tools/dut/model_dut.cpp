// Implements hmlfc_dut.h with the golden model: an example of a library for `hmlfc conform`.
#include <hmlfc/decoder.hpp>
#include <hmlfc/disparity.hpp>
#include <hmlfc/dut.hpp>
#include <hmlfc/frame_trace.hpp>
#include <hmlfc/renderer.hpp>

#include <algorithm>
#include <new>
#include <string>
#include <utility>

struct hmlfc_dut {
  hmlfc::Decoder decoder;
};

namespace {

hmlfc::BlockAddress address(uint32_t row, uint32_t col, uint32_t plane, uint32_t block_x,
                            uint32_t block_y) {
  return {{row, col}, static_cast<hmlfc::Plane>(plane), block_x, block_y};
}

// Passes stages on to the library's caller.
class Stages final : public hmlfc::TraceSink {
 public:
  Stages(hmlfc_dut_stage_sink sink, void* context) : sink_(sink), context_(context) {}

  void on_field(const hmlfc::FieldRecord&) override {}

  void on_stage(const hmlfc::StageRecord& record) override {
    const hmlfc::BlockSite& site = record.site;
    const std::string name(record.stage);
    const hmlfc_dut_stage stage{
        name.c_str(),   static_cast<uint32_t>(site.level),           site.image_row,
        site.image_col, static_cast<uint32_t>(site.plane),           site.bx,
        site.by,        static_cast<uint32_t>(record.values.size()), record.values.data()};
    sink_(context_, &stage);
  }

 private:
  hmlfc_dut_stage_sink sink_;
  void* context_;
};

}  // namespace

uint32_t hmlfc_dut_abi() { return HMLFC_DUT_ABI; }

const char* hmlfc_dut_name() { return "hmlfc golden model"; }

int hmlfc_dut_open(const uint8_t* bytes, size_t size, hmlfc_dut** dut) {
  *dut = nullptr;
  auto decoder = hmlfc::Decoder::open({bytes, size});
  if (!decoder) return hmlfc::dut_status(decoder.error());
  *dut = new (std::nothrow) hmlfc_dut{std::move(*decoder)};
  return *dut != nullptr ? 0 : static_cast<int>(hmlfc::ErrorCode::kOutOfMemory);
}

int hmlfc_dut_get_geometry(const hmlfc_dut* dut, hmlfc_dut_geometry* geometry) {
  *geometry = hmlfc::dut_geometry(dut->decoder.header());
  return 0;
}

int hmlfc_dut_decode_view(hmlfc_dut* dut, uint32_t row, uint32_t col, uint16_t* rgb) {
  const auto image = dut->decoder.decode_view({row, col});
  if (!image) return hmlfc::dut_status(image.error());
  std::ranges::copy(image->samples, rgb);
  return 0;
}

int hmlfc_dut_decode_block(hmlfc_dut* dut, uint32_t row, uint32_t col, uint32_t plane,
                           uint32_t block_x, uint32_t block_y, uint32_t stop_level,
                           int32_t* samples) {
  const auto block = dut->decoder.decode_block(address(row, col, plane, block_x, block_y),
                                               {.stop_level = static_cast<int>(stop_level)});
  if (!block) return hmlfc::dut_status(block.error());
  std::ranges::copy(*block, samples);
  return 0;
}

int hmlfc_dut_trace_block(hmlfc_dut* dut, uint32_t row, uint32_t col, uint32_t plane,
                          uint32_t block_x, uint32_t block_y, hmlfc_dut_stage_sink sink,
                          void* context) {
  Stages stages(sink, context);
  const auto block =
      dut->decoder.decode_block(address(row, col, plane, block_x, block_y), {.trace = &stages});
  return block ? 0 : hmlfc::dut_status(block.error());
}

int hmlfc_dut_frame_record(const hmlfc_dut* dut, const hmlfc_dut_camera* camera,
                           int32_t record[HMLFC_DUT_RECORD_NUMBERS], const char** input) {
  return hmlfc::dut_frame_record(*camera, dut->decoder.header(), record, input);
}

int hmlfc_dut_render_frame(hmlfc_dut* dut, const int32_t record[HMLFC_DUT_RECORD_NUMBERS],
                           uint32_t stop_level, uint16_t* rgb, hmlfc_dut_counts* counts) {
  const auto frame_record = hmlfc::frame_record_of(record);
  const int level = static_cast<int>(stop_level);
  hmlfc::Frame frame;
  const auto done = hmlfc::make_golden_renderer(dut->decoder)->render(frame_record, level, frame);
  if (!done) return hmlfc::dut_status(done.error());
  const auto needs = hmlfc::frame_needs(dut->decoder, frame_record, level);
  if (!needs) return hmlfc::dut_status(needs.error());
  std::ranges::copy(frame.image.samples, rgb);
  *counts = {static_cast<int64_t>(needs->pixels_outside),
             static_cast<int64_t>(needs->blocks.size()),
             static_cast<int64_t>(needs->disparities_looked_up)};
  return 0;
}

int hmlfc_dut_trace_pixel(hmlfc_dut* dut, const int32_t record[HMLFC_DUT_RECORD_NUMBERS],
                          uint32_t stop_level, uint32_t x, uint32_t y, hmlfc_dut_number_sink sink,
                          void* context) {
  const auto trace = hmlfc::frame_trace(dut->decoder, hmlfc::frame_record_of(record),
                                        static_cast<int>(stop_level), x, y);
  if (!trace) return hmlfc::dut_status(trace.error());
  for (const hmlfc::FrameStage& stage : trace->stages) {
    const std::string name(stage.name);
    for (const hmlfc::FrameValue& value : stage.values) {
      const std::string value_name(value.name);
      const hmlfc_dut_number number{
          name.c_str(), stage.view ? static_cast<int32_t>(stage.view->row) : -1,
          stage.view ? static_cast<int32_t>(stage.view->col) : -1, value_name.c_str(), value.value};
      sink(context, &number);
    }
  }
  return 0;
}

int hmlfc_dut_disparity_map(hmlfc_dut* dut, uint32_t row, uint32_t col, int16_t* disparities,
                            uint8_t* confidences) {
  const auto map = hmlfc::disparity_map(dut->decoder, {row, col});
  if (!map) return hmlfc::dut_status(map.error());
  for (const hmlfc::BlockDisparity& block : map->blocks) {
    *disparities++ = block.disparity;
    *confidences++ = block.confidence;
  }
  return 0;
}

const char* hmlfc_dut_error_name(int status) { return hmlfc::dut_error_name(status); }

void hmlfc_dut_close(hmlfc_dut* dut) { delete dut; }
