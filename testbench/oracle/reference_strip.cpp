#include <algorithm>
#include <bit>

#include "arithmetic/rounding.hpp"
#include "bits/bit_string.hpp"
#include "oracle/reference_area.hpp"

namespace hmlfc::tb {
namespace {

constexpr unsigned kWidthBits = 4;
constexpr unsigned kHeadBits = 20;
constexpr unsigned kWidestPacked = 14;
constexpr unsigned kRaw = 15;
constexpr unsigned kRawBits = 16;

// Writes the low `bits` bits of `value` at bit `at`; the bits there are 0.
void put(std::span<uint8_t> bytes, size_t at, unsigned bits, uint32_t value) {
  for (unsigned i = 0; i < bits; ++i, ++at) {
    const uint32_t bit = (value >> i) & 1u;
    bytes[at / 8] = static_cast<uint8_t>(bytes[at / 8] | bit << (at % 8));
  }
}

bool is_poison(int32_t sample) { return sample < poison_of(ErrorCode::kOk) + 32; }

}  // namespace

uint32_t strips_in_row(uint32_t width, unsigned block_size) {
  const uint32_t blocks = ceil_div(width, uint32_t{block_size});
  return ceil_div(blocks, uint32_t{kStripSamples / (block_size * block_size)});
}

std::array<uint8_t, kStripBytes> pack_strip(const StripSamples& samples) {
  const auto [least, most] = std::minmax_element(samples.begin(), samples.end());
  const unsigned needed =
      static_cast<unsigned>(std::bit_width(static_cast<uint32_t>(*most - *least)));
  const bool raw = needed > kWidestPacked || is_poison(*least);
  const unsigned bits = raw ? kRawBits : needed;
  const int32_t base = raw ? 0 : *least;
  std::array<uint8_t, kStripBytes> place{};
  put(place, 0, kWidthBits, raw ? kRaw : needed);
  put(place, kWidthBits, kHeadBits - kWidthBits, static_cast<uint32_t>(base));
  for (size_t i = 0; i < samples.size(); ++i) {
    put(place, kHeadBits + i * bits, bits, static_cast<uint32_t>(samples[i] - base));
  }
  return place;
}

StripSamples unpack_strip(std::span<const uint8_t, kStripBytes> place) {
  const BitString strip(place);
  const uint32_t width = strip.field(0, kWidthBits);
  const unsigned bits = width == kRaw ? kRawBits : width;
  const auto base = static_cast<int16_t>(strip.field(kWidthBits, kHeadBits - kWidthBits));
  StripSamples samples{};
  for (size_t i = 0; i < samples.size(); ++i) {
    const uint32_t field = strip.field(kHeadBits + i * bits, bits);
    samples[i] = width == kRaw ? static_cast<int16_t>(field) : base + static_cast<int32_t>(field);
  }
  return samples;
}

}  // namespace hmlfc::tb
