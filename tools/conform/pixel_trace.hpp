// Traces of pixels of frames: one JSON object a line, each a stage of `hmlfc render --trace
// --json`.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <hmlfc/hmlfc_dut.h>
#include <hmlfc/decoder.hpp>
#include <hmlfc/frame_trace.hpp>

namespace hmlfc::conform {

/// Gathers what hmlfc_dut_trace_pixel reports.
class PixelLines {
 public:
  /// An hmlfc_dut_number_sink; `lines` is a PixelLines.
  static void add(void* lines, const hmlfc_dut_number* number);

  /// " N" and N lines, each after a line feed.
  std::string text() const;

 private:
  std::vector<std::string> lines_;  // each but for its end, "]}"
  std::string stage_;               // of the last
};

/// The first number of `expected` that the lines in `actual` have otherwise, with its stage and
/// clause; else that all agree, or that there is none to compare. Numbers and stages that `actual`
/// leaves out, and lines that are no stages, are passed over.
std::string first_wrong_number(const FrameTrace& expected, std::string_view actual);

}  // namespace hmlfc::conform
