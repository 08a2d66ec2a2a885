// Values that the first thread that needs them makes.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

#include <hmlfc/error.hpp>

namespace hmlfc {

/// Thread-safe map from a number to an immutable value. Each value is made once; an error is not
/// kept, so a later call tries again.
template <class Value>
class LazyMap {
 public:
  using Pointer = std::shared_ptr<const Value>;

  /// The value of `key`; if there is none yet, `make() -> Result<Pointer>` makes it. Threads that
  /// want the same key wait for the one that makes it; others do not.
  template <class Make>
  Result<Pointer> get(uint64_t key, const Make& make) {
    const std::shared_ptr<Slot> slot = slot_of(key);
    const std::scoped_lock lock(slot->mutex);
    if (!slot->value) {
      Result<Pointer> made = make();
      if (!made) return made;
      slot->value = *made;
    }
    return slot->value;
  }

  /// The value of `key`, or null if it is not made yet.
  Pointer find(uint64_t key) {
    const std::shared_ptr<Slot> slot = slot_of(key);
    const std::scoped_lock lock(slot->mutex);
    return slot->value;
  }

  /// Calls `visit(const Value&)` for every value made so far.
  template <class Visit>
  void for_each(const Visit& visit) {
    const std::scoped_lock lock(mutex_);
    for (const auto& [key, slot] : slots_) {
      const std::scoped_lock slot_lock(slot->mutex);
      if (slot->value) visit(*slot->value);
    }
  }

 private:
  struct Slot {
    std::mutex mutex;
    Pointer value;
  };

  std::shared_ptr<Slot> slot_of(uint64_t key) {
    const std::scoped_lock lock(mutex_);
    std::shared_ptr<Slot>& slot = slots_[key];
    if (!slot) slot = std::make_shared<Slot>();
    return slot;
  }

  std::mutex mutex_;
  std::unordered_map<uint64_t, std::shared_ptr<Slot>> slots_;
};

/// Which of `count` parts of something have been filled. Thread-safe.
class FilledParts {
 public:
  explicit FilledParts(size_t count) : filled_(count) {}

  /// Calls `fill()` if `part` has not been filled; afterwards it has.
  template <class Fill>
  void fill_once(size_t part, const Fill& fill) {
    if (filled_[part].load(std::memory_order_acquire)) return;
    const std::scoped_lock lock(mutex_);
    if (filled_[part].load(std::memory_order_relaxed)) return;
    fill();
    filled_[part].store(true, std::memory_order_release);
  }

  /// Held while a part is filled.
  std::mutex& mutex() { return mutex_; }

 private:
  std::mutex mutex_;
  std::vector<std::atomic<bool>> filled_;
};

}  // namespace hmlfc
