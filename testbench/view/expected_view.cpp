#include "view/expected_view.hpp"

#include <algorithm>

#include "arithmetic/rounding.hpp"
#include "bits/little_endian.hpp"
#include "oracle/reference_area.hpp"
#include "stimulus/sequences.hpp"

namespace hmlfc::tb {
namespace {

constexpr uint32_t kMaxSide = 16384;
constexpr uint32_t kMaxPitch = 1u << 24;
constexpr uint64_t kMaxAddress = uint64_t{1} << 40;
constexpr uint32_t kStripColumn = 16;  // blocks
constexpr auto kTooLarge = static_cast<uint8_t>(ErrorCode::kLimitExceeded);

unsigned plane_of(ViewFormat format) {
  if (is_residuals(format)) return static_cast<unsigned>(format) & 3;
  return format <= ViewFormat::kCg ? static_cast<unsigned>(format) : kRgb;
}

// The bytes of one pixel, lowest first.
uint64_t pixel(const Answer& answer, ViewFormat format, size_t i, size_t lane) {
  const auto sample = [&](size_t c) {
    return uint64_t{static_cast<uint16_t>(answer.samples[c * lane + i])};
  };
  if (plane_of(format) != kRgb) return sample(0);
  const unsigned bits = bits_of(format);
  return sample(0) | sample(1) << bits | sample(2) << 2 * bits;
}

// A strip of a request for residuals; past the last block its first sample.
StripSamples strip_of(Oracle& oracle, const Descriptor& d, unsigned b, uint32_t first, uint32_t by,
                      ViewStatus& status) {
  const uint32_t blocks_x = ceil_div(d.width, b);
  const size_t lane = size_t{b} * b;
  StripSamples samples{};
  for (size_t i = 0; i < kStripSamples; i += lane) {
    const auto bx = static_cast<uint32_t>(first + i / lane);
    const auto to = samples.begin() + static_cast<ptrdiff_t>(i);
    if (bx >= blocks_x) {
      std::fill(to, samples.end(), samples[0]);
      break;
    }
    Request request{d.row, d.col, bx, by, plane_of(d.format), d.stop_level};
    request.residuals = true;
    const Answer answer = oracle.evaluate(request).answer;
    if (answer.status == 0) {
      std::copy_n(answer.samples.begin(), lane, to);
      continue;
    }
    std::fill_n(to, lane, poison_of(static_cast<ErrorCode>(answer.status)));
    if (status.block_errors++ == 0) status.first_error = answer.status;
    status.result = ViewResult::kBlocks;
  }
  return samples;
}

// The strips of a plane, in columns of 16 blocks.
void write_strips(Oracle& oracle, const Descriptor& d, unsigned b, SparseBytes& memory,
                  ViewStatus& status) {
  const std::span<uint8_t> strips = memory.at(d.destination);
  const uint32_t blocks_x = ceil_div(d.width, b);
  const uint32_t in_strip = kStripSamples / (b * b);
  for (uint32_t column = 0; column < blocks_x; column += kStripColumn) {
    for (uint32_t by = 0; by < ceil_div(d.height, b); ++by) {
      const uint32_t end = std::min(column + kStripColumn, blocks_x);
      for (uint32_t bx = column; bx < end; bx += in_strip) {
        const auto place = pack_strip(strip_of(oracle, d, b, bx, by, status));
        const unsigned words = ceil_div(strip_bits(place), 64u);
        const uint64_t at = uint64_t{by} * d.pitch + uint64_t{bx / in_strip} * kStripBytes;
        std::copy_n(place.begin(), 8 * words, strips.begin() + static_cast<ptrdiff_t>(at));
      }
    }
  }
}

}  // namespace

bool is_accepted(const Descriptor& d, unsigned block_size) {
  const bool format = d.format <= ViewFormat::kCg ||
                      (d.format >= ViewFormat::kRgb888 && d.format <= ViewFormat::kRgb161616) ||
                      (is_residuals(d.format) && d.x == 0 && d.y == 0 && d.bitmap == 0);
  return format && d.x % block_size == 0 && d.y % block_size == 0 && d.width != 0 &&
         d.height != 0 && d.x + d.width <= kMaxSide && d.y + d.height <= kMaxSide &&
         d.destination % 16 == 0 && d.destination < kMaxAddress && d.pitch % 16 == 0 &&
         d.pitch < kMaxPitch && d.bitmap % 8 == 0 && d.bitmap < kMaxAddress;
}

uint64_t bitmap_bytes(const Descriptor& d, unsigned block_size) {
  const uint32_t side = kTileBlocks * block_size;
  const uint64_t columns = (d.x + d.width - 1) / side - d.x / side + 1;
  const uint64_t rows = (d.y + d.height - 1) / side - d.y / side + 1;
  return 8 * columns * rows;
}

ViewStatus write_expected(Oracle& oracle, const Descriptor& d, unsigned b, SparseBytes& memory) {
  ViewStatus status{.tag = d.tag};
  if (!is_accepted(d, b)) {
    status.result = ViewResult::kRefused;
    return status;
  }
  if (is_residuals(d.format)) {
    write_strips(oracle, d, b, memory, status);
    return status;
  }
  const std::span<uint8_t> pixels = memory.at(d.destination);
  std::span<uint8_t> bitmap;
  if (d.bitmap != 0) bitmap = memory.at(d.bitmap).first(bitmap_bytes(d, b));
  std::ranges::fill(bitmap, uint8_t{0});
  const uint32_t end_x = d.x + d.width;
  const uint32_t end_y = d.y + d.height;
  const uint64_t tiles_x = (end_x - 1) / (kTileBlocks * b) - d.x / (kTileBlocks * b) + 1;
  const size_t lane = size_t{b} * b;
  const unsigned bytes = bytes_of(d.format);
  ScanOrder order(ceil_div(end_x, b), ceil_div(end_y, b));
  while (const auto block = order.next()) {
    if (block->bx < d.x / b || block->by < d.y / b) continue;
    const Answer answer =
        oracle.evaluate({d.row, d.col, block->bx, block->by, plane_of(d.format), d.stop_level})
            .answer;
    uint8_t error = answer.status;
    const unsigned columns = inside(end_x, block->bx, b);
    const unsigned rows = inside(end_y, block->by, b);
    for (size_t i = 0; i < lane; ++i) {
      if (i % b >= columns || i / b >= rows || plane_of(d.format) != kRgb || error != 0) continue;
      for (size_t c = 0; c < kLanes; ++c) {
        if (static_cast<uint16_t>(answer.samples[c * lane + i]) >> bits_of(d.format) != 0) {
          error = kTooLarge;
        }
      }
    }
    for (size_t i = 0; i < lane; ++i) {
      if (i % b >= columns || i / b >= rows) continue;
      const uint64_t at = (block->by * b + i / b - d.y) * uint64_t{d.pitch} +
                          (block->bx * b + i % b - d.x) * uint64_t{bytes};
      const uint64_t value = error == 0 ? pixel(answer, d.format, i, lane) : 0;
      for (unsigned k = 0; k < bytes; ++k) {
        pixels[at + k] = static_cast<uint8_t>(value >> 8 * k);
      }
    }
    if (error == 0) continue;
    if (status.block_errors++ == 0) status.first_error = error;
    status.result = ViewResult::kBlocks;
    if (d.bitmap == 0) continue;
    const uint64_t tile = (block->by / kTileBlocks - d.y / b / kTileBlocks) * tiles_x +
                          block->bx / kTileBlocks - d.x / b / kTileBlocks;
    bitmap[8 * tile + block->by % kTileBlocks] |=
        static_cast<uint8_t>(1u << block->bx % kTileBlocks);
  }
  return status;
}

}  // namespace hmlfc::tb
