// Finds, by reading on trial, what a partial source lacks of what is about to be read.
#pragma once

#include <mutex>
#include <utility>
#include <vector>

#include <hmlfc/byte_source.hpp>

#include "syntax/stream_view.hpp"

namespace hmlfc {

/// Stands for a partial source: notes what that does not hold, and loads nothing.
class MissingRanges final : public ByteSource {
 public:
  explicit MissingRanges(const ByteSource& source) : source_(source) {}

  std::span<const uint8_t> bytes() const override { return source_.bytes(); }
  bool is_partial() const override { return true; }
  bool holds(ByteRange range) const override { return source_.holds(range); }
  bool load(std::span<const ByteRange> ranges) override {
    const std::scoped_lock lock(mutex_);
    ranges_.insert(ranges_.end(), ranges.begin(), ranges.end());
    return false;
  }

  /// How many ranges were missed since the last take().
  size_t count() const {
    const std::scoped_lock lock(mutex_);
    return ranges_.size();
  }

  /// The ranges, some of them several times; afterwards none.
  std::vector<ByteRange> take() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(ranges_, {});
  }

 private:
  const ByteSource& source_;
  mutable std::mutex mutex_;
  std::vector<ByteRange> ranges_;
};

/// Calls `trial(view, missing)` until it misses nothing or what it missed cannot be loaded. `view`
/// is `stream`, which has a partial source; a read of bytes that are missing gives bus_error there
/// and is noted in `missing`. What one call missed is loaded at once: reads that do not depend on
/// each other take one round. Returns whether the last call missed nothing.
template <class Trial>
bool load_by_trials(const StreamView& stream, const Trial& trial) {
  MissingRanges missing(*stream.source);
  StreamView view = stream;
  view.source = &missing;
  for (;;) {
    trial(std::as_const(view), std::as_const(missing));
    if (missing.count() == 0) return true;
    if (!stream.source->load(missing.take())) return false;
  }
}

}  // namespace hmlfc
