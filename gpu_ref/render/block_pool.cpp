#include "block_pool.hpp"

#include <algorithm>
#include <string>

#include "device/submission.hpp"

namespace hmlfc::gpu {
namespace {

constexpr uint64_t kSlots = 32;                    // of a page
constexpr uint64_t kFirstPages = 512;              // made room for at once
constexpr uint64_t kMaxWords = uint64_t{1} << 32;  // that shaders can number

}  // namespace

BlockPool::BlockPool(const BlockSizes& sizes, uint64_t words, uint64_t budget)
    : words_(words),
      page_words_(kSlots * sizes.sample_words),
      kept_pages_(std::min({words, budget / (4 * page_words_), kMaxWords / page_words_})) {}

void BlockPool::reserve(Device::State& device, uint64_t pages) {
  const uint64_t most = std::max(kept_pages_, device.submission_bytes / (4 * page_words_));
  if (pages > most) {
    throw MachineError(FailureKind::kLimit, "the frame's blocks take " + std::to_string(pages) +
                                                " pages of " + std::to_string(4 * page_words_) +
                                                " bytes on the device, more than the " +
                                                std::to_string(most) + " that there is room for");
  }
  held_.reserve(device, 4 * words_);
  page_numbers_.reserve(device, 4 * words_);
  const Buffer& used = used_pages_.reserve(device, 8);
  if (samples_ && pages <= pages_) return;
  const uint64_t ahead = samples_ ? std::min({2 * pages_, most, words_}) : kFirstPages;
  samples_.reset();
  pages_ = std::max({pages, kept_pages_, std::min(words_, ahead)});
  samples_.emplace(device, pages_ * page_words_);
  Submission commands(device);
  commands.fill(used, 0, used.size(), kUsedNothingHeld);
  commands.run();
}

void BlockPool::describe(FrameArguments& frame) const {
  frame.held = held_.get().address();
  frame.pages = page_numbers_.get().address();
  frame.used_pages = used_pages_.get().address();
  frame.pool = samples_->address(chunked());
  frame.pool_chunk_log2 = samples_->chunk_log2();
  frame.pool_pages = static_cast<uint32_t>(pages_);
  frame.kept_pages = static_cast<uint32_t>(kept_pages_);
}

}  // namespace hmlfc::gpu
