// Whole light fields from and to folders of views.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <hmlfc/image.hpp>
#include <hmlfc/light_field.hpp>

#include "io/image_files.hpp"
#include "io/io_error.hpp"
#include "io/parallel.hpp"
#include "io/view_list.hpp"

namespace hmlfc::io {

/// Reads all views, each file once, on `threads` threads (0: all cores). The result has the size
/// and depth of the views; the first view and one image per thread are in memory besides.
///
/// Errors: a file that read_image() refuses (the first in row-major order is named), a view whose
/// size or depth differs from most others (named with both), not enough memory.
IoResult<LightField> load_light_field(const ViewList& views, unsigned threads,
                                      const Progress& progress = {}, Notes* notes = nullptr);

/// The picture of view (row, col); called from several threads at once.
using ViewProducer = std::function<IoResult<RgbImage>(uint32_t row, uint32_t col)>;

/// How files of views are named, and their format.
enum class FileNames : uint8_t {
  kRowCol,  ///< PNG, view_file_name()
  kPleno,   ///< PPM, pleno_file_name()
  kHci,     ///< PNG, camera_file_name()
};

struct SavedAs {
  FileNames names = FileNames::kRowCol;
  std::string software = {};  ///< as write_png() notes it
};

/// Makes `folder` if it is missing and writes rows x cols views there; each file appears complete
/// or not at all, other files stay. Errors: cannot write, or what `produce` returned (the first in
/// row-major order).
IoResult<void> save_views(const std::filesystem::path& folder, GridShape grid,
                          const ViewProducer& produce, unsigned threads,
                          const Progress& progress = {}, const SavedAs& as = {});

/// The names of the files that save_views() writes, row by row.
std::vector<std::string> view_file_names(GridShape grid, FileNames names);

/// Writes all views of `field`, as above.
IoResult<void> save_views(const std::filesystem::path& folder, const LightField& field,
                          unsigned threads, const Progress& progress = {});

}  // namespace hmlfc::io
