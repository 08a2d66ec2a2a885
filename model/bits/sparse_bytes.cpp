#include "bits/sparse_bytes.hpp"

#include <algorithm>
#include <atomic>
#include <bit>

namespace hmlfc {
namespace {

constexpr uint64_t kPageLines = SparseBytes::kPageBytes / SparseBytes::kLineBytes;
static_assert(kPageLines == 64, "a word has a bit for each line of a page");

uint64_t pages_in(uint64_t bytes) {
  return (bytes + SparseBytes::kPageBytes - 1) / SparseBytes::kPageBytes;
}

}  // namespace

SparseBytes::SparseBytes(uint64_t size)
    : size_(size),
      file_(size),
      lines_(pages_in(size) * sizeof(uint64_t)),
      used_(pages_in(size) * sizeof(uint32_t)) {}

bool SparseBytes::is_reserved() const {
  return file_.data() != nullptr && lines_.data() != nullptr && used_.data() != nullptr;
}

uint64_t& SparseBytes::lines_of(uint64_t page) const {
  return reinterpret_cast<uint64_t*>(lines_.data())[page];
}

uint32_t& SparseBytes::used_of(uint64_t page) const {
  return reinterpret_cast<uint32_t*>(used_.data())[page];
}

// Calls visit(page, mask of its lines in `range`) until one gives false; returns whether none did.
template <class Visit>
bool SparseBytes::all_words(ByteRange range, const Visit& visit) {
  if (range.bytes == 0) return true;
  const uint64_t first = range.offset / kLineBytes;
  const uint64_t last = (range.offset + range.bytes - 1) / kLineBytes;
  for (uint64_t page = first / kPageLines; page <= last / kPageLines; ++page) {
    uint64_t mask = ~uint64_t{0};
    if (page == first / kPageLines) mask &= mask << (first % kPageLines);
    if (page == last / kPageLines) mask &= ~uint64_t{0} >> (kPageLines - 1 - last % kPageLines);
    if (!visit(page, mask)) return false;
  }
  return true;
}

bool SparseBytes::contains(ByteRange range) const {
  return range.offset <= size_ && range.bytes <= size_ - range.offset;
}

bool SparseBytes::holds(ByteRange range) const {
  if (!contains(range)) return false;
  return all_words(range, [this](uint64_t page, uint64_t mask) {
    std::atomic_ref(used_of(page)).store(now_, std::memory_order_relaxed);
    return (std::atomic_ref(lines_of(page)).load(std::memory_order_acquire) & mask) == mask;
  });
}

bool SparseBytes::holds_any(uint64_t begin, uint64_t end) const {
  for (uint64_t at = begin; at < end; at += kLineBytes) {
    if ((lines_of(at / kPageBytes) >> (at / kLineBytes % kPageLines) & 1u) != 0) return true;
  }
  return false;
}

std::vector<ByteRange> SparseBytes::missing(std::span<const ByteRange> ranges, uint64_t gap) const {
  std::vector<ByteRange> lines;
  for (const ByteRange& range : ranges) {
    if (!contains(range)) continue;
    all_words(range, [&](uint64_t page, uint64_t mask) {
      for (uint64_t left = mask & ~lines_of(page); left != 0; left &= left - 1) {
        const auto line = static_cast<uint64_t>(std::countr_zero(left));
        const uint64_t at = page * kPageBytes + line * kLineBytes;
        lines.push_back({at, std::min(kLineBytes, size_ - at)});
      }
      return true;
    });
  }
  std::ranges::sort(lines, {}, &ByteRange::offset);
  std::vector<ByteRange> merged;
  for (const ByteRange& line : lines) {
    const uint64_t end = merged.empty() ? 0 : merged.back().offset + merged.back().bytes;
    if (!merged.empty() && line.offset <= end + gap && !holds_any(end, line.offset)) {
      merged.back().bytes = std::max(end, line.offset + line.bytes) - merged.back().offset;
    } else {
      merged.push_back(line);
    }
  }
  return merged;
}

std::span<uint8_t> SparseBytes::room(ByteRange range) {
  if (!contains(range)) return {};
  return {file_.data() + range.offset, static_cast<size_t>(range.bytes)};
}

void SparseBytes::set_loaded(ByteRange range) {
  if (!contains(range)) return;
  all_words(range, [this](uint64_t page, uint64_t mask) {
    const std::atomic_ref lines(lines_of(page));
    if (lines.load(std::memory_order_relaxed) == 0) pages_.push_back(page);
    lines.fetch_or(mask, std::memory_order_release);
    std::atomic_ref(used_of(page)).store(now_, std::memory_order_relaxed);
    return true;
  });
}

void SparseBytes::drop_to(uint64_t bytes) {
  if (held_bytes() <= bytes) return;
  std::ranges::sort(pages_, std::ranges::greater{},
                    [this](uint64_t page) { return used_of(page); });
  const auto kept = pages_.begin() + static_cast<ptrdiff_t>(bytes / kPageBytes);
  std::for_each(kept, pages_.end(), [this](uint64_t page) {
    lines_of(page) = 0;
    file_.clear(page * kPageBytes, kPageBytes);
  });
  pages_.erase(kept, pages_.end());
}

}  // namespace hmlfc
