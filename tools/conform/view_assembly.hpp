// A decoder's geometry and its blocks put together, as the golden model's header has them.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <hmlfc/hmlfc_dut.h>
#include <hmlfc/decoder.hpp>

namespace hmlfc::conform {

/// The first field of `geometry` that differs from the header: "width 64 instead of 60".
std::optional<std::string> wrong_geometry(const StreamHeader& header,
                                          const hmlfc_dut_geometry& geometry);

/// B * B samples of a block at stop level 0, or the error's name.
using BlockSource =
    std::function<tl::expected<std::vector<int32_t>, std::string>(const BlockAddress& block)>;

/// A view from its blocks (COL-2, COL-3), asked for in the order of DEC-7. The first error ends it.
tl::expected<RgbImage, std::string> assemble_view(const Decoder& golden, ViewPos view,
                                                  const BlockSource& source);

}  // namespace hmlfc::conform
