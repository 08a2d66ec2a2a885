#include "programs/unit_decoder.hpp"

#include <hmlfc/decoder.hpp>
#include <hmlfc/dut.hpp>

#include <algorithm>
#include <utility>

struct hmlfc_dut {
  std::unique_ptr<hmlfc::tb::UnitDecoder> decoder;
};

namespace hmlfc::tb {
namespace {

// Requests all blocks of a view in `plane` (for kRgb as many as plane Y has), row by row.
std::vector<Request> view_requests(const Geometry& geometry, ViewPos view, unsigned plane) {
  const PlaneShape& shape = geometry.plane(plane == kRgb ? Plane::kY : static_cast<Plane>(plane));
  std::vector<Request> requests;
  for (uint32_t by = 0; by < shape.blocks_y; ++by) {
    for (uint32_t bx = 0; bx < shape.blocks_x; ++bx) {
      requests.push_back({.row = view.row, .col = view.col, .bx = bx, .by = by, .plane = plane});
    }
  }
  return requests;
}

// Three lanes of B x B samples become pixels; those outside the view have no meaning.
void place(const Request& request, const Answer& answer, unsigned b, RgbImage& image) {
  for (uint32_t i = 0; i < b * b; ++i) {
    const uint32_t x = request.bx * b + i % b;
    const uint32_t y = request.by * b + i / b;
    if (x >= image.width || y >= image.height) continue;
    for (size_t lane = 0; lane < kLanes; ++lane) {
      image.samples[(size_t{y} * image.width + x) * 3 + lane] =
          static_cast<uint16_t>(answer.samples[lane * b * b + i]);
    }
  }
}

// Tells the stages of one level.
class StageTeller {
 public:
  StageTeller(unsigned b, hmlfc_dut_stage_sink sink, void* context)
      : count_(b * b), sink_(sink), context_(context) {}

  void operator()(const LevelRecord& record) const {
    if (record.error != 0) return;
    if (record.motion) tell(record, "reference", record.reference);
    if (!record.key) tell(record, "prediction", record.prediction);
    if (record.has_residual) tell(record, "residual", record.residual);
    tell(record, "sample", record.sample);
  }

 private:
  void tell(const LevelRecord& record, const char* name, const StageValues& values) const {
    const std::vector<int32_t> wide(values.begin(), values.begin() + count_);
    const BlockSite& site = record.site;
    const hmlfc_dut_stage stage{name,
                                static_cast<uint32_t>(site.level),
                                site.image_row,
                                site.image_col,
                                static_cast<uint32_t>(site.plane),
                                site.bx,
                                site.by,
                                count_,
                                wide.data()};
    sink_(context_, &stage);
  }

  unsigned count_;
  hmlfc_dut_stage_sink sink_;
  void* context_;
};

}  // namespace

UnitResult<std::unique_ptr<UnitDecoder>> UnitDecoder::open(std::span<const uint8_t> stream) {
  static const std::vector<UnitMaker> makers = rtl_units();
  const UnitMaker* maker = unit_for(makers, stream);
  if (maker == nullptr) return tl::unexpected(HMLFC_DUT_CANNOT_RUN);
  std::unique_ptr<UnitDecoder> decoder(new UnitDecoder(stream, *maker));
  if (const uint8_t error = decoder->unit_.load(); error != 0) return tl::unexpected(int{error});
  const auto opened = Decoder::open(stream);
  if (!opened) return tl::unexpected(dut_status(opened.error()));
  if (decoder->image_.golden() == nullptr) return tl::unexpected(int{decoder->image_.load_error()});
  return decoder;
}

UnitResult<RgbImage> UnitDecoder::view(ViewPos view) {
  const auto requests = view_requests(image_.golden()->geometry(), view, kRgb);
  const auto answers = unit_.answers(requests);
  RgbImage image{header().width, header().height, header().depth, {}};
  image.samples.resize(size_t{image.width} * image.height * 3);
  for (size_t i = 0; i < requests.size(); ++i) {
    if (answers[i].status != 0) return tl::unexpected(error_of_view(view, answers[i].status));
    place(requests[i], answers[i], header().block_size(), image);
  }
  return image;
}

// The error of a view in which a block failed with `status`. Requests for RGB go through all planes
// block by block; the error of a view is that of the planes in turn (DEC-7).
int UnitDecoder::error_of_view(ViewPos view, int status) {
  for (unsigned plane = 0; plane < kRgb; ++plane) {
    for (const Answer& answer :
         unit_.answers(view_requests(image_.golden()->geometry(), view, plane))) {
      if (answer.status != 0) return static_cast<int>(answer.status);
    }
  }
  return status;
}

UnitResult<std::vector<int32_t>> UnitDecoder::block(const Request& request) {
  const Answer answer = unit_.answers(std::span(&request, 1)).front();
  if (answer.status != 0) return tl::unexpected(static_cast<int>(answer.status));
  const unsigned b = header().block_size();
  return std::vector<int32_t>(answer.samples.begin(), answer.samples.begin() + b * b);
}

int UnitDecoder::trace(const Request& request, hmlfc_dut_stage_sink sink, void* context) {
  unit_.on_record = StageTeller(header().block_size(), sink, context);
  const int status = static_cast<int>(unit_.answers(std::span(&request, 1)).front().status);
  unit_.on_record = {};
  return status;
}

conform::DutFunctions unit_functions() {
  conform::DutFunctions functions;
  functions.open = [](const uint8_t* bytes, size_t size, hmlfc_dut** dut) {
    *dut = nullptr;
    auto opened = UnitDecoder::open({bytes, size});
    if (!opened) return opened.error();
    *dut = new hmlfc_dut{std::move(*opened)};
    return 0;
  };
  functions.get_geometry = [](const hmlfc_dut* dut, hmlfc_dut_geometry* geometry) {
    *geometry = dut_geometry(dut->decoder->header());
    return 0;
  };
  functions.decode_view = [](hmlfc_dut* dut, uint32_t row, uint32_t col, uint16_t* rgb) {
    const auto image = dut->decoder->view({row, col});
    if (!image) return image.error();
    std::ranges::copy(image->samples, rgb);
    return 0;
  };
  functions.decode_block = [](hmlfc_dut* dut, uint32_t row, uint32_t col, uint32_t plane,
                              uint32_t x, uint32_t y, uint32_t level, int32_t* samples) {
    const auto block = dut->decoder->block(
        {.row = row, .col = col, .bx = x, .by = y, .plane = plane, .stop_level = level});
    if (!block) return block.error();
    std::ranges::copy(*block, samples);
    return 0;
  };
  functions.trace_block = [](hmlfc_dut* dut, uint32_t row, uint32_t col, uint32_t plane, uint32_t x,
                             uint32_t y, hmlfc_dut_stage_sink sink, void* context) {
    return dut->decoder->trace({.row = row, .col = col, .bx = x, .by = y, .plane = plane}, sink,
                               context);
  };
  functions.error_name = dut_error_name;
  functions.close = [](hmlfc_dut* dut) { delete dut; };
  return functions;
}

}  // namespace hmlfc::tb
