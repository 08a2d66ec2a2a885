#include <hmlfc/read_sink.hpp>

#include <algorithm>
#include <atomic>
#include <bit>

namespace hmlfc {

TouchedBytes::TouchedBytes(uint64_t file_bytes)
    : lines_(static_cast<size_t>(file_bytes / kLineBytes / 64 + 1)) {}

void TouchedBytes::on_read(uint64_t offset, uint64_t bytes) {
  if (bytes == 0) return;
  for (uint64_t line = offset / kLineBytes; line <= (offset + bytes - 1) / kLineBytes; ++line) {
    const std::atomic_ref<uint64_t> word(lines_[static_cast<size_t>(line / 64)]);
    const uint64_t bit = uint64_t{1} << (line % 64);
    if ((word.load(std::memory_order_relaxed) & bit) == 0) {
      word.fetch_or(bit, std::memory_order_relaxed);
    }
  }
}

uint64_t TouchedBytes::bytes() const {
  uint64_t lines = 0;
  for (const uint64_t word : lines_) lines += static_cast<uint64_t>(std::popcount(word));
  return lines * kLineBytes;
}

void TouchedBytes::reset() {
  std::fill(lines_.begin(), lines_.end(), uint64_t{0});
  key_samples_ = 0;
}

}  // namespace hmlfc
