// The cached views of one frame by their place in the grid, for one thread.
#pragma once

#include <array>
#include <cstdint>

#include "render/shown_image.hpp"
#include "render/view_cache.hpp"

namespace hmlfc {

/// Remembers the views last asked for, so that the cache is asked for each but once in a while.
class ViewLookup {
 public:
  ViewLookup(ViewCache& cache, const StreamHeader& header, int stop_level)
      : cache_(cache), header_(header), stop_level_(stop_level) {}

  CachedView& at(int32_t row, int32_t col) {
    Entry& entry = entries_[static_cast<size_t>((row * 16 + col) & (kEntries - 1))];
    if (entry.view == nullptr || entry.row != row || entry.col != col) {
      const ViewPos place{static_cast<uint32_t>(row), static_cast<uint32_t>(col)};
      entry = {row, col, &cache_.use(first_view_of(header_, place, stop_level_), stop_level_)};
    }
    return *entry.view;
  }

 private:
  static constexpr int32_t kEntries = 256;

  struct Entry {
    int32_t row = 0;
    int32_t col = 0;
    CachedView* view = nullptr;
  };

  ViewCache& cache_;
  const StreamHeader& header_;
  int stop_level_;
  std::array<Entry, kEntries> entries_;
};

}  // namespace hmlfc
