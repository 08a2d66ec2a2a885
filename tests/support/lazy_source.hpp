// A partial source for tests: shows what it was asked to load and nothing else.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <hmlfc/byte_source.hpp>

namespace hmlfc::test {

/// Loads exactly the ranges that it is asked for; all other bytes are wrong ones. When no request
/// is left it drops all it has. Fails from call number `failing` of load() on, counted from 0.
class LazySource final : public ByteSource {
 public:
  static constexpr size_t kNever = std::numeric_limits<size_t>::max();

  explicit LazySource(std::vector<uint8_t> file, size_t failing = kNever)
      : file_(std::move(file)), shown_(file_.size()), loaded_(file_.size()), failing_(failing) {
    drop();
  }

  std::span<const uint8_t> bytes() const override { return shown_; }
  bool is_partial() const override { return true; }

  bool holds(ByteRange range) const override {
    const std::scoped_lock lock(mutex_);
    const auto first = loaded_.begin() + static_cast<ptrdiff_t>(range.offset);
    return std::all_of(first, first + static_cast<ptrdiff_t>(range.bytes),
                       [](uint8_t loaded) { return loaded != 0; });
  }

  bool load(std::span<const ByteRange> ranges) override {
    const std::scoped_lock lock(mutex_);
    if (loads_++ >= failing_) failed_ = true;
    if (failed_) return false;
    for (const ByteRange& range : ranges) {
      std::copy_n(file_.begin() + static_cast<ptrdiff_t>(range.offset), range.bytes,
                  shown_.begin() + static_cast<ptrdiff_t>(range.offset));
      std::fill_n(loaded_.begin() + static_cast<ptrdiff_t>(range.offset), range.bytes, uint8_t{1});
    }
    most_loaded_ = loaded_;
    const auto held = std::count(loaded_.begin(), loaded_.end(), uint8_t{1});
    most_held_ = std::max(most_held_, static_cast<size_t>(held));
    return true;
  }

  void begin_request() override {
    const std::scoped_lock lock(mutex_);
    ++requests_;
  }

  void end_request() override {
    const std::scoped_lock lock(mutex_);
    if (--requests_ == 0) drop();
  }

  std::string failure() const override {
    const std::scoped_lock lock(mutex_);
    return failed_ ? "it was told to fail" : "";
  }

  size_t loads() const { return loads_; }

  /// Most bytes that were there at once since the last call, or since the beginning.
  size_t take_most_held() { return std::exchange(most_held_, 0); }

  /// 1 for each byte that was there after the last load().
  const std::vector<uint8_t>& loaded() const { return most_loaded_; }

 private:
  void drop() {
    for (size_t i = 0; i < shown_.size(); ++i) {
      shown_[i] = static_cast<uint8_t>(~file_[i] + i / 7 * 31);
      loaded_[i] = 0;
    }
  }

  const std::vector<uint8_t> file_;
  std::vector<uint8_t> shown_;
  std::vector<uint8_t> loaded_;  // 1 or 0
  std::vector<uint8_t> most_loaded_;
  size_t failing_;
  size_t loads_ = 0;
  size_t most_held_ = 0;
  size_t requests_ = 0;
  bool failed_ = false;
  mutable std::mutex mutex_;
};

}  // namespace hmlfc::test
