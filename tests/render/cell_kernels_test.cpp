// The kernels of cells against the golden functions, at the limits of SRF-3, on every instruction
// set.
#include <gtest/gtest.h>

#include <array>

#include "render/cell_kernels.hpp"
#include "scenes/test_light_fields.hpp"
#include "support/instruction_sets.hpp"

namespace hmlfc {
namespace {

constexpr int32_t kCells = 97;

template <class Values>
int32_t one_of(test::Random& random, const Values& values) {
  return values[random() % values.size()];
}

// Weights of an axis of `views` views that sum to 256, often such that views have just enough of
// the weight, or not quite.
void draw_weights(test::Random& random, int32_t views, AxisRun& axis) {
  constexpr std::array kWeights{128, 127, 129, 160, 159, 161, 96, 64, 1, 255, 200};
  axis.choose(0, views - 1);
  for (size_t i = 0; i < kCells; ++i) {
    axis.weight[0][i] = views == 1 ? 256 : one_of(random, kWeights);
    if (views == 2) axis.weight[1][i] = 256 - axis.weight[0][i];
  }
}

// Proposals::chosen() of a cell.
int32_t chosen(const RunTaps& weights, const ToldByViews& told, const FrameRecord& record,
               size_t cell) {
  Proposals proposals;
  size_t view = 0;
  for (int32_t row = 0; row < weights.rows.views; ++row) {
    for (int32_t col = 0; col < weights.cols.views; ++col) {
      const int32_t d = told[view++][cell];
      const BlockDisparity block{static_cast<int16_t>(d == kNoDisparity ? 0 : d),
                                 static_cast<uint8_t>(d == kNoDisparity ? 0 : 1)};
      proposals.add(displacement_of(block, record),
                    weights.cols.weight[col][cell] * weights.rows.weight[row][cell]);
    }
  }
  return proposals.chosen();
}

TEST(CellKernels, ChooseWhatProposalsChoose) {
  constexpr std::array kTold{kNoDisparity, 50,        -50, 49,  50 + 2048, 50 + 2049,
                             50 - 2048,    50 - 2049, 300, -49, -32768,    32767};
  constexpr std::array kFocus{0, 50, -7, 65536, -65536};
  constexpr std::array kFine{0, 1, 50, 256};
  test::Random random(5);
  for (int n = 0; n < 200; ++n) {
    RayRun run;
    run.begin = static_cast<int32_t>(random() % 20);
    run.end = kCells - static_cast<int32_t>(random() % 20);
    RunTaps weights(kCells);
    draw_weights(random, 1 + static_cast<int32_t>(random() % 2), weights.rows);
    draw_weights(random, 1 + static_cast<int32_t>(random() % 2), weights.cols);
    ToldByViews told;
    for (auto& of_view : told) {
      of_view.resize(kCells);
      for (int32_t& d : of_view) d = one_of(random, kTold);
    }
    FrameRecord record{};
    record.focus = one_of(random, kFocus);
    record.fine = one_of(random, kFine);
    for (const int64_t target : test::instruction_sets()) {
      const test::ChosenInstructionSet chosen_set(target);
      std::vector<int32_t> cells(kCells, 12345);
      choose_displacements(record, run, weights, told, cells.data());
      for (int32_t i = 0; i < kCells; ++i) {
        const auto at = static_cast<size_t>(i);
        const bool inside = i >= run.begin && i < run.end;
        ASSERT_EQ(cells[at], inside ? chosen(weights, told, record, at) : 12345)
            << test::instruction_set_name(target) << ", case " << n << ", cell " << i;
      }
    }
  }
}

}  // namespace
}  // namespace hmlfc
