#include "guarded_pages.hpp"

#ifdef _WIN32

#include "device_state.hpp"

namespace hmlfc::gpu {

GuardedPages::GuardedPages(size_t) : size_(0), mapping_(nullptr) {
  throw MachineError(FailureKind::kUnusable, "DeviceOptions::guard_pages needs a POSIX system");
}
GuardedPages::GuardedPages(GuardedPages&&) noexcept = default;
GuardedPages::~GuardedPages() = default;
void* GuardedPages::data() const { return mapping_; }

}  // namespace hmlfc::gpu

#else

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <new>
#include <utility>

#include "arithmetic/rounding.hpp"

namespace hmlfc::gpu {
namespace {

size_t page_size() { return static_cast<size_t>(sysconf(_SC_PAGESIZE)); }

}  // namespace

GuardedPages::GuardedPages(size_t bytes)
    : size_(page_size() * ceil_div(bytes, page_size())), mapping_(nullptr) {
  void* const mapping =
      mmap(nullptr, size_ + 2 * page_size(), PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (mapping == MAP_FAILED) throw std::bad_alloc();
  mapping_ = mapping;
  if (mprotect(data(), size_, PROT_READ | PROT_WRITE) != 0) {
    munmap(mapping_, size_ + 2 * page_size());
    throw std::bad_alloc();
  }
}

GuardedPages::GuardedPages(GuardedPages&& other) noexcept
    : size_(other.size_), mapping_(std::exchange(other.mapping_, nullptr)) {}

GuardedPages::~GuardedPages() {
  if (mapping_ != nullptr) munmap(mapping_, size_ + 2 * page_size());
}

void* GuardedPages::data() const { return static_cast<uint8_t*>(mapping_) + page_size(); }

}  // namespace hmlfc::gpu

#endif
