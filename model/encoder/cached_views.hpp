// Views in memory, and views that are kept there for a while.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>

#include <hmlfc/view_provider.hpp>

namespace hmlfc {

/// The views of a light field in memory, which must outlive this.
class FieldViews final : public ViewProvider {
 public:
  explicit FieldViews(const LightField& field) : field_(field) {}

  const LightFieldShape& shape() const override { return field_.shape(); }
  RgbImage view(ViewPos at) const override { return field_.view(at.row, at.col); }

 private:
  const LightField& field_;
};

/// One rectangle of all views of another provider, which must outlive this. What was fetched last is
/// kept.
class CachedViews final : public ViewProvider {
 public:
  static constexpr uint64_t kUnlimited = ~uint64_t{0};

  /// `part` lies in the views. At most `max_bytes` are kept, and one view more for each thread.
  CachedViews(const ViewProvider& views, const Rect& part, uint64_t max_bytes);

  /// Whole views.
  CachedViews(const ViewProvider& views, uint64_t max_bytes)
      : CachedViews(views, {0, 0, views.shape().width, views.shape().height}, max_bytes) {}

  const LightFieldShape& shape() const override { return shape_; }
  RgbImage view(ViewPos at) const override;

 private:
  struct Kept {
    std::shared_ptr<const LightField> view;  // of one view
    uint64_t last_use = 0;
  };

  std::shared_ptr<const LightField> fetch(ViewPos at) const;

  const ViewProvider& views_;
  Rect part_;
  LightFieldShape shape_;
  uint64_t view_bytes_;
  uint64_t max_views_;
  mutable std::mutex mutex_;
  mutable std::map<uint64_t, Kept> kept_;  // by row * cols + column
  mutable uint64_t uses_ = 0;
};

}  // namespace hmlfc
