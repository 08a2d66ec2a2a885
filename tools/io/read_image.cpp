#include "io/image_files.hpp"

#include <new>
#include <string>

#include "io/files.hpp"
#include "io/image_reader.hpp"

namespace hmlfc::io {

IoResult<RgbImage> allocate_image(const ImageSource& source, uint64_t width, uint64_t height,
                                  int depth) {
  const std::string size = std::to_string(width) + " x " + std::to_string(height);
  if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide) {
    return file_error(source.path,
                      "a picture of " + size + " pixels; each side must be 1 to 65536");
  }
  const uint64_t samples = width * height * 3;  // at most 3 * 2^32
  if (samples > source.limits.max_samples) {
    return file_error(source.path, "a picture of " + size + " pixels is over the limit of " +
                                       std::to_string(source.limits.max_samples / 3) + " pixels");
  }
  RgbImage image{static_cast<uint32_t>(width), static_cast<uint32_t>(height), depth, {}};
  try {
    image.samples.resize(samples);
  } catch (const std::bad_alloc&) {
    return memory_error(source.path, "for a picture of " + size + " pixels");
  }
  return image;
}

IoResult<RgbImage> read_image(const std::filesystem::path& path, const ImageLimits& limits,
                              Notes* notes) {
  const auto file = map_file(path);
  if (!file) return tl::unexpected(file.error());
  Notes ignored;
  const ImageSource source{path, file->bytes(), limits, notes != nullptr ? *notes : ignored};
  if (source.bytes.empty()) return file_error(path, "the file is empty; give a picture");
  if (is_png(source.bytes)) return read_png(source);
  if (is_jpeg(source.bytes)) return read_jpeg(source);
  if (is_pnm(source.bytes)) return read_pnm(source);
  return file_error(path, "not a PNG, JPEG, PPM or PGM picture; convert it to one of these");
}

}  // namespace hmlfc::io
