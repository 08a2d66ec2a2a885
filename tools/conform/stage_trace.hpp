// The stages of one block as text, and the first of them that two decoders disagree on.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <hmlfc/hmlfc_dut.h>
#include <hmlfc/decoder.hpp>

namespace hmlfc::conform {

/// One stage of one block of one image of the tree.
struct Stage {
  std::string stage;  ///< "parent", "reference", "prediction", "residual" or "sample"
  uint32_t level = 0;
  uint32_t image_row = 0;
  uint32_t image_col = 0;
  Plane plane = Plane::kY;
  uint32_t block_x = 0;
  uint32_t block_y = 0;
  std::vector<int32_t> values;  ///< B * B, row by row

  bool same_place(const Stage& other) const {
    return stage == other.stage && level == other.level && image_row == other.image_row &&
           image_col == other.image_col && plane == other.plane && block_x == other.block_x &&
           block_y == other.block_y;
  }
};

/// One line of JSON, a stage record of the suite's traces (vectors/README.md):
/// {"record":"stage","level":0,"image":[1,2],"plane":"Y","block":[3,4],"stage":"sample",
/// "values":[...]}.
std::string stage_line(const hmlfc_dut_stage& stage);

/// The stages of all lines of `text` that have this form; other lines are passed over.
std::vector<Stage> parse_stages(std::string_view text);

/// The stages of the golden model at stop level 0, and the clause of each; up to the error where
/// the block has one.
std::vector<std::pair<Stage, std::string>> golden_stages(const Decoder& decoder,
                                                         const BlockAddress& block);

/// The first stage, in the golden model's order, that `actual` reports otherwise:
/// "stage residual (TIL-10) at level 1 image 0,2 plane Y block 3,1: value 5 (x 1, y 1) is -3
/// instead of -2". Nothing where all that it reports agree. Stages that it leaves out are passed
/// over; values outside the plane are not compared.
std::optional<std::string> first_wrong_stage(const Decoder& decoder, const BlockAddress& block,
                                             const std::vector<Stage>& actual);

}  // namespace hmlfc::conform
