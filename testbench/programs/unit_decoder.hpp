// One stream in a Verilated decode unit, and the functions of hmlfc_dut.h for it.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <hmlfc/hmlfc_dut.h>
#include <hmlfc/image.hpp>

#include "conform/dut_library.hpp"
#include "systemc/stream_image.hpp"
#include "unit/unit_host.hpp"
#include "unit/units.hpp"

namespace hmlfc::tb {

/// A nonzero status of annex A, or HMLFC_DUT_CANNOT_RUN.
template <class T>
using UnitResult = tl::expected<T, int>;

/// The unit decodes; software checks the CRCs of sections (FIL-6) and the TOP table (KEY-1), and
/// decodes key images. Functions throw UnitHangs.
class UnitDecoder {
 public:
  /// `stream` must outlive the decoder.
  static UnitResult<std::unique_ptr<UnitDecoder>> open(std::span<const uint8_t> stream);

  const StreamHeader& header() const { return image_.golden()->header(); }
  UnitResult<RgbImage> view(ViewPos view);
  UnitResult<std::vector<int32_t>> block(const Request& request);

  /// Gives the stages of a block to `sink` from the unit's trace port.
  int trace(const Request& request, hmlfc_dut_stage_sink sink, void* context);

 private:
  UnitDecoder(std::span<const uint8_t> stream, const UnitMaker& maker)
      : image_(stream, maker.parameters),
        unit_(maker.make(maker.parameters, nullptr), stream, image_.area().bytes) {}

  int error_of_view(ViewPos view, int status);

  StreamImage image_;
  UnitHost unit_;
};

/// The functions of hmlfc_dut.h for a UnitDecoder.
conform::DutFunctions unit_functions();

}  // namespace hmlfc::tb
