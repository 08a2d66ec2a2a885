// Geometry and views of a decoder under test, as the golden model's header has them.
#pragma once

#include <optional>
#include <string>

#include <hmlfc/hmlfc_dut.h>
#include <hmlfc/decoder.hpp>

#include "conform/running_dut.hpp"

namespace hmlfc::conform {

/// The first field of `geometry` that differs from the header: "width 64 instead of 60".
std::optional<std::string> wrong_geometry(const StreamHeader& header,
                                          const hmlfc_dut_geometry& geometry);

/// A view of the stream that `dut` has open. With `by_block`, or where it gives no views, put
/// together from its blocks (COL-2, COL-3), asked for in the order of DEC-7; the first error ends
/// it. Throws DutFailure.
DutAnswer<RgbImage> view_of(RunningDut& dut, bool by_block, const Decoder& golden, ViewPos view);

}  // namespace hmlfc::conform
