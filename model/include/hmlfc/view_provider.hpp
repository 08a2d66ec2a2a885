// A light field whose views are fetched when they are needed.
#pragma once

#include <hmlfc/export.hpp>
#include <hmlfc/format.hpp>
#include <hmlfc/image.hpp>
#include <hmlfc/light_field.hpp>

namespace hmlfc {

/// Where an encoder gets views from that do not all fit in memory.
class HMLFC_EXPORT ViewProvider {
 public:
  virtual ~ViewProvider() = default;

  /// Returns the shape of the whole light field, which never changes.
  virtual const LightFieldShape& shape() const = 0;

  /// View `at` of the grid, always the same picture, of the size and depth of shape(). Called
  /// several times for a view, and by several threads at once. What it throws reaches the caller of
  /// the encoder.
  virtual RgbImage view(ViewPos at) const = 0;
};

}  // namespace hmlfc
