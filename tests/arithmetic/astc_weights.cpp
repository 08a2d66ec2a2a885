#include "arithmetic/astc_weights.hpp"

#include <algorithm>

namespace hmlfc::test {
namespace {

// The level counts that weights have; index 2 * H + R, R in [2, 7] first without, then with the
// high precision bit H.
constexpr std::array<uint32_t, 6> kLowLevels{2, 3, 4, 5, 6, 8};
constexpr std::array<uint32_t, 6> kHighLevels{10, 12, 16, 20, 24, 32};

// Bits h (6 down to 0), each 0 where its letter is not in the word: how the specification's table
// of weight unquantisation spells B and A, with a = bit 0 of the plain bits, b = bit 1, c = bit 2.
uint32_t spell(const char* word, uint32_t plain) {
  uint32_t value = 0;
  for (; *word != '\0'; ++word) {
    const uint32_t bit = *word == '0' ? 0 : (plain >> (*word - 'a')) & 1u;
    value = 2 * value + bit;
  }
  return value;
}

struct DigitRule {
  uint32_t levels;
  unsigned plain_bits;
  const char* b_word;
  uint32_t c;
};

// Table "weight unquantization parameters".
constexpr DigitRule kDigitRules[] = {
    {6, 1, "0000000", 50},  {12, 2, "b000b0b", 23}, {24, 3, "cb000cb", 11},
    {10, 1, "0000000", 28}, {20, 2, "b0000b0", 13},
};

uint32_t unquantised_63(uint32_t value, uint32_t levels) {
  switch (levels) {
    case 2:
      return value * 63;
    case 3:
      return std::array<uint32_t, 3>{0, 32, 63}[value];
    case 4:
      return value * 0b010101;
    case 5:
      return std::array<uint32_t, 5>{0, 16, 32, 47, 63}[value];
    case 8:
      return value * 0b001001;
    case 16:
      return value << 2 | value >> 2;
    case 32:
      return value << 1 | value >> 4;
    default:
      break;
  }
  for (const DigitRule& rule : kDigitRules) {
    if (rule.levels != levels) continue;
    const uint32_t plain = value % (1u << rule.plain_bits);
    const uint32_t digit = value >> rule.plain_bits;
    const uint32_t a = spell("aaaaaaa", plain);
    const uint32_t t = (digit * rule.c + spell(rule.b_word, plain)) ^ a;
    return (a & 0x20u) | (t >> 2);
  }
  return 0;
}

uint32_t unquantised(uint32_t value, uint32_t levels) {
  const uint32_t weight = unquantised_63(value, levels);
  return weight > 32 ? weight + 1 : weight;
}

// Position of texel s on a side of `size` weights, in sixteenths of a weight.
uint32_t grid_position(uint32_t s, uint32_t size) {
  const uint32_t scale = (1024 + kFootprint / 2) / (kFootprint - 1);
  return (scale * s * (size - 1) + 32) >> 6;
}

}  // namespace

std::optional<uint32_t> astc_block_mode(const WeightGrid& grid) {
  const auto* const low = std::find(kLowLevels.begin(), kLowLevels.end(), grid.levels);
  const auto* const high = std::find(kHighLevels.begin(), kHighLevels.end(), grid.levels);
  if (low == kLowLevels.end() && high == kHighLevels.end()) return std::nullopt;
  const bool h = low == kLowLevels.end();
  const auto r =
      static_cast<uint32_t>(2 + (h ? high - kHighLevels.begin() : low - kLowLevels.begin()));

  NaiveBits mode;
  const auto layout = [&](unsigned select, uint32_t a, uint32_t b) {
    mode.put(r >> 1, 2)
        .put(select, 2)
        .put(r & 1, 1)
        .put(a, 2)
        .put(b, 2)
        .put(h ? 1 : 0, 1)
        .put(0, 1);
    return static_cast<uint32_t>(mode.field(0, 11));
  };
  const unsigned w = grid.width;
  const unsigned g = grid.height;
  if (w >= 4 && w <= 7 && g >= 2 && g <= 5) return layout(0, g - 2, w - 4);
  if (w >= 8 && w <= 11 && g >= 2 && g <= 5) return layout(1, g - 2, w - 8);
  if (w >= 2 && w <= 5 && g >= 8 && g <= 11) return layout(2, w - 2, g - 8);
  if (w >= 2 && w <= 5 && g >= 6 && g <= 7) return layout(3, w - 2, g - 6);
  if (w >= 2 && w <= 3 && g >= 2 && g <= 5) return layout(3, g - 2, 2 + w - 2);
  return std::nullopt;
}

std::array<uint8_t, 16> astc_block(uint32_t block_mode, const NaiveBits& sequence) {
  NaiveBits bits;
  bits.put(block_mode, 11);
  // One partition (2 bits), colour endpoint mode 0 (4 bits), endpoints: all 0.
  while (bits.size() < 128 - sequence.size()) bits.put(0, 1);
  // Weights stand bit-reversed: bit 0 of the sequence is bit 127 of the block.
  for (size_t k = sequence.size(); k-- > 0;) bits.put(sequence[k] ? 1 : 0, 1);
  std::array<uint8_t, 16> block{};
  const std::vector<uint8_t> bytes = bits.bytes();
  std::copy(bytes.begin(), bytes.end(), block.begin());
  return block;
}

std::vector<uint32_t> astc_texel_weights(const WeightGrid& grid,
                                         const std::vector<uint32_t>& values) {
  const auto at = [&](uint32_t x, uint32_t y) {
    const bool inside = x < grid.width && y < grid.height;  // outside counts with weight 0
    return inside ? unquantised(values[y * grid.width + x], grid.levels) : 0;
  };
  std::vector<uint32_t> weights;
  for (uint32_t t = 0; t < kFootprint; ++t) {
    for (uint32_t s = 0; s < kFootprint; ++s) {
      const uint32_t gs = grid_position(s, grid.width);
      const uint32_t gt = grid_position(t, grid.height);
      const uint32_t x = gs >> 4, fs = gs & 15;
      const uint32_t y = gt >> 4, ft = gt & 15;
      const uint32_t w11 = (fs * ft + 8) >> 4;
      const uint32_t w10 = ft - w11;
      const uint32_t w01 = fs - w11;
      const uint32_t w00 = 16 - fs - ft + w11;
      weights.push_back(
          (at(x, y) * w00 + at(x + 1, y) * w01 + at(x, y + 1) * w10 + at(x + 1, y + 1) * w11 + 8) >>
          4);
    }
  }
  return weights;
}

}  // namespace hmlfc::test
