#include "render/disparity_cache.hpp"

#include <algorithm>
#include <numeric>

#include "arithmetic/rounding.hpp"
#include "decoder/open_stream.hpp"
#include "render/block_disparity.hpp"
#include "render/surface.hpp"

namespace hmlfc {

ViewDisparities::ViewDisparities(const StreamView& stream, ViewPos view)
    : stream_(&stream),
      view_(view),
      columns_(stream.geometry.plane(Plane::kY).blocks_x),
      looked_up_(size_t{columns_} * stream.geometry.plane(Plane::kY).blocks_y),
      rows_(stream.geometry.plane(Plane::kY).blocks_y),
      pages_(ceil_div(stream.geometry.plane(Plane::kY).blocks_y, kPageBlockRows)) {}

void ViewDisparities::look_up(std::span<const int32_t> bx, std::span<const int32_t> by,
                              std::span<int32_t> told) {
  for (size_t i = 0; i < told.size(); ++i) {
    const auto x = static_cast<uint32_t>(bx[i]);
    const auto y = static_cast<uint32_t>(by[i]);
    const int32_t* row = rows_[y].load(std::memory_order_acquire);
    if (row == nullptr) row = read(y);
    told[i] = row[x];
    std::atomic_ref(looked_up_[size_t{y} * columns_ + x]).store(1, std::memory_order_relaxed);
  }
}

const int32_t* ViewDisparities::read(uint32_t by) {
  const std::lock_guard lock(reading_);
  if (rows_[by] == nullptr) {
    const uint32_t first = by / kPageBlockRows * kPageBlockRows;
    const uint32_t end = std::min(first + kPageBlockRows, static_cast<uint32_t>(rows_.size()));
    std::vector<int32_t>& page = pages_[by / kPageBlockRows];
    page.resize(size_t{columns_} * (end - first));
    std::ranges::transform(disparity_rows(*stream_, view_, first, end), page.begin(),
                           [](const BlockDisparity& block) {
                             return block.confidence == 0 ? kNoDisparity : block.disparity;
                           });
    bytes_read_ += page.size() * sizeof(int32_t);
    new_pages_.push_back(by / kPageBlockRows);
    for (uint32_t row = first; row < end; ++row) {
      rows_[row].store(page.data() + size_t{row - first} * columns_, std::memory_order_release);
    }
  }
  return rows_[by];
}

void ViewDisparities::begin_frame(uint64_t number, const StreamView& stream) {
  if (frame_ == number) return;
  frame_ = number;
  stream_ = &stream;
  std::fill(looked_up_.begin(), looked_up_.end(), uint8_t{0});
}

void ViewDisparities::drop_pages() {
  for (const uint32_t page : new_pages_) {
    const size_t first = size_t{page} * kPageBlockRows;
    const size_t end = std::min<size_t>(first + kPageBlockRows, rows_.size());
    for (size_t row = first; row < end; ++row) rows_[row] = nullptr;
    bytes_read_ -= pages_[page].size() * sizeof(int32_t);
    pages_[page] = {};
  }
  new_pages_.clear();
}

uint64_t ViewDisparities::blocks_looked_up() const {
  return std::accumulate(looked_up_.begin(), looked_up_.end(), uint64_t{0});
}

DisparityCache::DisparityCache(const Decoder& decoder, size_t budget)
    : stream_(&DecoderAccess::stream(decoder)), budget_(budget) {}

void DisparityCache::begin_frame(const StreamView& stream) {
  ++frame_;
  stream_ = &stream;
  for (const auto& [key, view] : views_) view->drop_pages();
}

ViewDisparities& DisparityCache::use(ViewPos view) {
  const uint64_t key = uint64_t{view.row} << 32 | view.col;
  {
    const std::shared_lock lock(mutex_);
    const auto found = views_.find(key);
    if (found != views_.end() && found->second->frame() == frame_) return *found->second;
  }
  const std::unique_lock lock(mutex_);
  auto& used = views_[key];
  if (!used) used = std::make_unique<ViewDisparities>(*stream_, view);
  used->begin_frame(frame_, *stream_);
  return *used;
}

uint64_t DisparityCache::blocks_looked_up() const {
  uint64_t blocks = 0;
  for (const auto& [key, view] : views_) {
    if (view->frame() == frame_) blocks += view->blocks_looked_up();
  }
  return blocks;
}

void DisparityCache::end_frame() {
  size_t bytes = 0;
  for (const auto& [key, view] : views_) {
    view->keep_pages();
    bytes += view->bytes_read();
  }
  for (auto view = views_.begin(); view != views_.end() && bytes > budget_;) {
    if (view->second->frame() == frame_) {
      ++view;
      continue;
    }
    bytes -= view->second->bytes_read();
    view = views_.erase(view);
  }
}

}  // namespace hmlfc
