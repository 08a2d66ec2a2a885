// The views of a light field, wherever they come from, one at a time.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <hmlfc/decoder.hpp>
#include <hmlfc/light_field.hpp>

#include "io/view_list.hpp"

namespace hmlfc::cli {

/// A folder of pictures or an .hmlfc stream. All const functions may be called from several threads
/// at the same time.
class ViewSource {
 public:
  virtual ~ViewSource() = default;

  virtual const LightFieldShape& shape() const = 0;

  /// View `view`, which lies in the grid. Failures: a picture that cannot be read or has another
  /// size or depth than the first (kInput), a corrupt stream (kCorrupt).
  virtual RgbImage view(ViewPos view) const = 0;

  /// Opens `path`; `grid` is for a folder whose names do not tell. Failures: nothing there, not a
  /// light field (kInput), a corrupt stream (kCorrupt).
  static std::unique_ptr<ViewSource> open(const std::filesystem::path& path,
                                          std::optional<io::GridShape> grid);

  /// Usage failure unless `view` is in the grid.
  void check_view(ViewPos view) const;
};

/// "9 x 9 views of 512 x 384 pixels, 8 bits".
std::string describe(const LightFieldShape& shape);

}  // namespace hmlfc::cli
