#include "io/image_files.hpp"

#include "io/files.hpp"
#include "io/image_reader.hpp"

namespace hmlfc::io {
namespace {

IoResult<RgbImage> read_source(const ImageSource& source) {
  if (source.bytes.empty()) return file_error(source.path, "the file is empty; give a picture");
  if (is_png(source.bytes)) return read_png(source);
  if (is_jpeg(source.bytes)) return read_jpeg(source);
  if (is_tiff(source.bytes)) return read_tiff(source);
  if (is_webp(source.bytes)) return read_webp(source);
  if (is_pnm(source.bytes)) return read_pnm(source);
  return file_error(source.path,
                    "not a PNG, JPEG, TIFF, WebP, PPM or PGM picture; convert it to one of these");
}

}  // namespace

IoResult<RgbImage> read_image(const std::filesystem::path& path, const ImageLimits& limits,
                              Notes* notes) {
  const auto file = map_file(path);
  if (!file) return tl::unexpected(file.error());
  Notes remarks;
  auto image = read_source({path, file->bytes(), limits, remarks});
  if (image && notes != nullptr) notes->add(remarks);
  return image;
}

}  // namespace hmlfc::io
