// A partial source for tests that lies: bytes that are fetched again may be others.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bits/sparse_source.hpp"

namespace hmlfc::test {

/// The source of web servers and of hmlfc_open_source(), with a cache that keeps nothing between
/// requests. What is fetched is right until lie() is called; from then on a fetch changes `changed`
/// in 256 of its bytes, at places that follow from `seed`.
class ChangingSource final : public SparseSource {
 public:
  ChangingSource(std::vector<uint8_t> file, uint32_t seed, uint32_t changed)
      : SparseSource(file.size(), {.gap = 64, .cache_bytes = 1}),
        file_(std::move(file)),
        state_(seed * uint64_t{2654435761} + 1),
        changed_(changed) {}

  void lie() { lies_ = true; }

  /// From now on each fetch gives `file`, as long as the one before.
  void become(std::vector<uint8_t> file) { file_ = std::move(file); }

 private:
  std::string fetch(std::span<const ByteRange> ranges) override {
    for (const ByteRange& range : ranges) {
      const std::span<uint8_t> to = room(range);
      std::copy_n(file_.begin() + static_cast<ptrdiff_t>(range.offset), to.size(), to.begin());
      for (size_t i = 0; lies_ && i < to.size(); ++i) {
        if (random() % 256 < changed_) to[i] = static_cast<uint8_t>(random());
      }
    }
    return {};
  }

  uint32_t random() {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<uint32_t>(state_ >> 33);
  }

  std::vector<uint8_t> file_;
  uint64_t state_;
  uint32_t changed_;
  bool lies_ = false;
};

}  // namespace hmlfc::test
