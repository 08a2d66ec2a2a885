#include "bits/sparse_source.hpp"

#include <algorithm>

namespace hmlfc {

bool SparseSource::load(std::span<const ByteRange> ranges) {
  const std::lock_guard lock(fetching_);
  if (failed_.load(std::memory_order_relaxed)) return false;
  const auto lies_in = [this](ByteRange range) { return file_.contains(range); };
  if (!std::ranges::all_of(ranges, lies_in)) return false;
  const auto missing = file_.missing(ranges, keeping_.gap);
  if (missing.empty()) return true;
  failure_ = fetch(missing);
  if (!failure_.empty()) {
    failed_.store(true, std::memory_order_release);
    return false;
  }
  for (const ByteRange& range : missing) file_.set_loaded(range);
  return true;
}

void SparseSource::begin_request() {
  const std::lock_guard lock(requests_mutex_);
  ++requests_;
}

void SparseSource::end_request() {
  const std::lock_guard lock(requests_mutex_);
  if (--requests_ > 0) return;
  const std::lock_guard fetching(fetching_);
  file_.drop_to(keeping_.cache_bytes);
  file_.tick();
}

std::string SparseSource::failure() const {
  return failed_.load(std::memory_order_acquire) ? failure_ : std::string();
}

uint64_t SparseSource::held_bytes() const {
  const std::lock_guard lock(fetching_);
  return file_.held_bytes();
}

}  // namespace hmlfc
