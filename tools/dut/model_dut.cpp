// Implements hmlfc_dut.h with the golden model: an example of a library for `hmlfc conform`.
#include <hmlfc/decoder.hpp>
#include <hmlfc/dut.hpp>

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

const char* hmlfc_dut_error_name(int status) { return hmlfc::dut_error_name(status); }

void hmlfc_dut_close(hmlfc_dut* dut) { delete dut; }
