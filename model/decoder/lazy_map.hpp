// Values that are made once, on first use, by whichever thread needs them first.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <unordered_map>

#include <hmlfc/error.hpp>

namespace hmlfc {

/// Thread-safe map from a number to an immutable value. Each value is made once; an error is not
/// kept, so a later call tries again.
template <class Value>
class LazyMap {
 public:
  /// The value of `key`, made by `make() -> Result<Value>` where it is not there yet. Threads that
  /// want the same key wait for the one that makes it; others do not.
  template <class Make>
  Result<std::shared_ptr<const Value>> get(uint64_t key, const Make& make) {
    const std::shared_ptr<Slot> slot = slot_of(key);
    const std::scoped_lock lock(slot->mutex);
    if (!slot->value) {
      Result<Value> made = make();
      if (!made) return tl::unexpected(made.error());
      slot->value = std::make_shared<const Value>(std::move(*made));
    }
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
    std::shared_ptr<const Value> value;
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

}  // namespace hmlfc
