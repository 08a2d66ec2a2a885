// The views of a light field, wherever they come from, one at a time.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <hmlfc/decoder.hpp>
#include <hmlfc/light_field.hpp>

#include "io/image_files.hpp"
#include "io/view_list.hpp"

namespace hmlfc::cli {

/// A folder of images or an .hmlfc stream. Const functions may be called concurrently.
class ViewSource {
 public:
  virtual ~ViewSource() = default;

  virtual const LightFieldShape& shape() const = 0;

  /// View `view`, which lies in the grid. Failures: an image that cannot be read, or whose size or
  /// depth differs from the first (kInput); a corrupt stream (kCorrupt).
  virtual RgbImage view(ViewPos view) const = 0;

  /// Opens `path`; `grid` as for io::list_views. Notes what the format cannot hold of a folder's
  /// images. Failures: nothing there, not a light field (kInput), a corrupt stream (kCorrupt).
  static std::unique_ptr<ViewSource> open(const std::filesystem::path& path,
                                          std::optional<io::GridShape> grid);

  /// Usage failure unless `view` is in the grid.
  void check_view(ViewPos view) const;
};

/// Usage failure unless `rect` lies in a view and is not empty.
void check_rect(const Rect& rect, const LightFieldShape& shape);

/// Tells the user what reading `path` lost; nothing where it lost nothing.
void note_losses(const std::filesystem::path& path, const io::ImageLosses& losses);

/// The shape of the light field in a stream.
LightFieldShape shape_of(const StreamHeader& header);

/// "9 x 9 views of 512 x 384 pixels, 8 bits".
std::string describe(const LightFieldShape& shape);

}  // namespace hmlfc::cli
