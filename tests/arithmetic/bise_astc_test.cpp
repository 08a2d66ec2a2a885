// BISE against the ASTC decoder of libastcenc, which shares no code with this project: the same
// bits read as ASTC weights. ASTC has the level counts 2 to 32.
#include <array>
#include <cstdint>
#include <memory>
#include <random>
#include <set>
#include <vector>

#include <astcenc.h>
#include <gtest/gtest.h>

#include "arithmetic/astc_weights.hpp"
#include "arithmetic/bise.hpp"
#include "bits/naive_bits.hpp"

namespace hmlfc {
namespace {

using test::NaiveBits;
using test::WeightGrid;
using Values = std::vector<uint32_t>;

struct ContextDeleter {
  void operator()(astcenc_context* context) const { astcenc_context_free(context); }
};

class BiseAstc : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    astcenc_config config;
    ASSERT_EQ(astcenc_config_init(ASTCENC_PRF_LDR, test::kFootprint, test::kFootprint, 1,
                                  ASTCENC_PRE_FAST, ASTCENC_FLG_DECOMPRESS_ONLY, &config),
              ASTCENC_SUCCESS);
    astcenc_context* context = nullptr;
    ASSERT_EQ(astcenc_context_alloc(&config, 1, &context), ASTCENC_SUCCESS);
    context_.reset(context);
  }
  static void TearDownTestSuite() { context_.reset(); }

  /// Each grid that has a block mode and weights of [24, 96] bits.
  static std::vector<WeightGrid> grids() {
    std::vector<WeightGrid> grids;
    for (unsigned code = 1; levels_of_code(code).count <= 32; ++code) {
      const Levels levels = levels_of_code(code);
      for (unsigned width = 2; width <= test::kFootprint; ++width) {
        for (unsigned height = 2; height <= test::kFootprint; ++height) {
          const WeightGrid grid{width, height, levels.count};
          const uint64_t bits = bise_bits(levels, grid.count());
          if (!test::astc_block_mode(grid) || grid.count() > 64 || bits < 24 || bits > 96) continue;
          grids.push_back(grid);
        }
      }
    }
    return grids;
  }

  /// Texel weights in [0, 64] that the library finds in a block with these weight bits.
  static void read_with_library(const WeightGrid& grid, const NaiveBits& sequence,
                                Values& weights) {
    const auto block = test::astc_block(*test::astc_block_mode(grid), sequence);
    astcenc_block_info info;
    ASSERT_EQ(astcenc_get_block_info(context_.get(), block.data(), &info), ASTCENC_SUCCESS);
    ASSERT_FALSE(info.is_error_block) << grid.width << "x" << grid.height;
    ASSERT_EQ(info.weight_level_count, grid.levels);
    ASSERT_EQ(info.weight_x, grid.width);
    ASSERT_EQ(info.weight_y, grid.height);
    weights.clear();
    for (unsigned i = 0; i < info.texel_count; ++i) {
      // The library gives sixteenths of the format's weights.
      weights.push_back(static_cast<uint32_t>(info.weight_values_plane1[i] * 16.0f));
    }
  }

  static void compare(const WeightGrid& grid, const NaiveBits& sequence, const Values& values) {
    Values weights;
    ASSERT_NO_FATAL_FAILURE(read_with_library(grid, sequence, weights));
    ASSERT_EQ(weights, test::astc_texel_weights(grid, values))
        << grid.width << "x" << grid.height << " weights of " << grid.levels << " levels";
  }

  inline static std::unique_ptr<astcenc_context, ContextDeleter> context_;
};

Levels levels_with(uint32_t count) { return levels_of_code(level_code_for(count)); }

Values read_all(const NaiveBits& sequence, const Levels& levels, size_t count) {
  const std::vector<uint8_t> bytes = sequence.bytes();
  Values values;
  for (size_t i = 0; i < count; ++i) {
    values.push_back(bise_value(BitString(bytes), 0, levels, count, i));
  }
  return values;
}

// The grids below exercise every weight range and every length of the last group.
TEST_F(BiseAstc, GridsCoverAllRangesAndTails) {
  std::set<uint32_t> levels;
  std::set<unsigned> trit_tails, quint_tails;
  for (const WeightGrid& grid : grids()) {
    levels.insert(grid.levels);
    const Digit digit = levels_with(grid.levels).digit;
    if (digit == Digit::kTrit) trit_tails.insert(grid.count() % 5);
    if (digit == Digit::kQuint) quint_tails.insert(grid.count() % 3);
  }
  EXPECT_EQ(levels.size(), 12u);
  EXPECT_EQ(trit_tails.size(), 5u);
  EXPECT_EQ(quint_tails.size(), 3u);
}

TEST_F(BiseAstc, TheLibraryReadsWhatBisePutWrites) {
  std::mt19937 random(1);
  for (const WeightGrid& grid : grids()) {
    for (int round = 0; round < 20; ++round) {
      Values values(grid.count());
      for (uint32_t& value : values) {
        value = std::uniform_int_distribution(0u, grid.levels - 1)(random);
      }
      BitWriter writer;
      bise_put(writer, levels_with(grid.levels), values);
      NaiveBits sequence;
      for (uint64_t k = 0; k < writer.size(); ++k) {
        sequence.put(BitString(writer.bytes()).field(k, 1), 1);
      }
      ASSERT_NO_FATAL_FAILURE(compare(grid, sequence, values));
    }
  }
}

TEST_F(BiseAstc, BiseValueReadsEveryBitPatternAsTheLibrary) {
  std::mt19937 random(2);
  for (const WeightGrid& grid : grids()) {
    const Levels levels = levels_with(grid.levels);
    for (int round = 0; round < 20; ++round) {
      NaiveBits sequence;
      while (sequence.size() < bise_bits(levels, grid.count())) sequence.put(random() & 1u, 1);
      const Values values = read_all(sequence, levels, grid.count());
      ASSERT_NO_FATAL_FAILURE(compare(grid, sequence, values));
    }
  }
}

// All 256 codes T and all 128 codes Q in each group of a sequence without plain bits.
TEST_F(BiseAstc, EveryDigitCodeInEveryGroup) {
  for (const WeightGrid& grid : {WeightGrid{5, 6, 3}, WeightGrid{6, 5, 5}}) {
    const Levels levels = levels_with(grid.levels);
    const unsigned code_bits = grid.levels == 3 ? 8 : 7;
    const uint64_t bits = bise_bits(levels, grid.count());
    for (unsigned code = 0; code < (1u << code_bits); ++code) {
      NaiveBits sequence;
      while (sequence.size() < bits) sequence.put(code + sequence.size() / code_bits, code_bits);
      ASSERT_EQ(sequence.size(), bits) << "whole groups";
      const Values values = read_all(sequence, levels, grid.count());
      ASSERT_NO_FATAL_FAILURE(compare(grid, sequence, values));
    }
  }
}

}  // namespace
}  // namespace hmlfc
