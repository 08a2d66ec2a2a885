// The stages of one block as text, and the first of them that two decoders disagree on.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <hmlfc/hmlfc_dut.h>
#include <hmlfc/decoder.hpp>

#include "vectors/expected.hpp"

namespace hmlfc::conform {

/// One line of JSON, a stage record of the suite's traces (vectors/README.md):
/// {"record":"stage","level":0,"image":[1,2],"plane":"Y","block":[3,4],"stage":"sample",
/// "values":[...]}.
std::string stage_line(const hmlfc_dut_stage& stage);

/// The stages of all lines of `text` that have this form, without their clauses; other lines are
/// ignored.
std::vector<vectors::RecordedStage> parse_stages(std::string_view text);

/// The first of the values of a block, row by row, that differs inside the plane: "value 5 (x 1, y
/// 1) is -3 instead of -2", or "is missing instead of". Nothing if all agree.
std::optional<std::string> first_wrong_value(const Decoder& decoder, Plane plane, uint32_t bx,
                                             uint32_t by, std::span<const int32_t> expected,
                                             std::span<const int32_t> actual);

/// The first stage, in the golden model's order, whose values differ in `actual`:
/// "stage residual (TIL-10) at level 1 image 0,2 plane Y block 3,1: value 5 (x 1, y 1) is -3
/// instead of -2". Nothing if all reported stages agree. Stages that `actual` lacks are skipped,
/// values outside the plane are not compared. An error of the block ends the comparison.
std::optional<std::string> first_wrong_stage(const Decoder& decoder, const BlockAddress& block,
                                             int stop_level,
                                             const std::vector<vectors::RecordedStage>& actual);

}  // namespace hmlfc::conform
