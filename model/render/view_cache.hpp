// The views that frames read, kept between frames within a budget of bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <shared_mutex>
#include <unordered_map>
#include <vector>

#include "render/cached_view.hpp"

namespace hmlfc {

/// Decoded views of one light field by stop level and place. Pages that no frame has needed for
/// longest go first when the budget is full; those of the current frame stay.
class ViewCache {
 public:
  ViewCache(const StreamHeader& header, size_t budget, bool keeps_luma)
      : shape_(header, keeps_luma), budget_(budget) {}

  const ViewShape& shape() const { return shape_; }

  /// Begins a frame: from now on the frame needs nothing.
  void begin_frame();

  /// The view at `place`, which is made where it is not there; the frame uses it. May be called by
  /// several threads at once.
  CachedView& use(ViewPos place, int stop_level);

  /// The view at `place` if there is one; not while another thread calls use().
  const CachedView* find(ViewPos place, int stop_level) const;

  /// The views that the frame uses, by stop level and place.
  std::vector<CachedView*> used();

  /// Marks the pages that the frame needs, and drops others so that those still to be made fit in
  /// the budget, where they can.
  void make_room();

  /// Drops the pages of this frame too, the largest first, where they alone exceed the budget.
  void end_frame();

  /// Bytes of the pages held.
  size_t bytes() const;

 private:
  struct PlacedPage {
    uint64_t frame;
    CachedView* view;
    uint32_t page;
  };

  static uint64_t key_of(ViewPos place, int stop_level) {
    return (static_cast<uint64_t>(stop_level) << 32 | place.row) << 16 | place.col;
  }

  void drop_oldest(size_t wanted_bytes, bool also_of_this_frame);

  const ViewShape shape_;
  size_t budget_;
  uint64_t frame_ = 0;
  std::shared_mutex mutex_;
  std::unordered_map<uint64_t, std::unique_ptr<CachedView>> views_;
};

}  // namespace hmlfc
