// Memory of the host for buffers of tests: an access past its end ends the process.
#pragma once

#include <cstddef>

namespace hmlfc::gpu {

/// Zeroed pages with an inaccessible page before and after them. Throws std::bad_alloc;
/// MachineError, kUnusable, on Windows.
class GuardedPages {
 public:
  /// At least `bytes` bytes, rounded up to whole pages.
  explicit GuardedPages(size_t bytes);
  GuardedPages(GuardedPages&& other) noexcept;
  GuardedPages& operator=(GuardedPages&&) = delete;
  ~GuardedPages();

  void* data() const;
  size_t size() const { return size_; }

 private:
  size_t size_;
  void* mapping_;  // with both guards; null after a move
};

}  // namespace hmlfc::gpu
