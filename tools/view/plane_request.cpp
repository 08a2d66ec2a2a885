#include "view/plane_request.hpp"

#include <fmt/format.h>

#include "io/pictures.hpp"
#include "view/query.hpp"

namespace hmlfc::view {

PlaneRequest read_plane_request(const Query& query, bool plane,
                                const std::function<void(CLI::App&, PlaneRequest&)>& add) {
  PlaneRequest request;
  read_query(query, [&](CLI::App& app) {
    cli::add_view(app, request.view, "")->required();
    cli::add_levels(app, request.levels);
    if (plane) cli::add_plane(app, request.plane);
    if (add) add(app, request);
  });
  return request;
}

int stop_level(const cli::StreamFile& file, const PlaneRequest& request) {
  file.check_view(*request.view);
  return request.levels ? file.stop_level(*request.levels) : 0;
}

RgbImage decoded(const cli::StreamFile& file, const PlaneRequest& request) {
  const int level = stop_level(file, request);
  return file.value(file.decoder().decode_view(*request.view, level));
}

Response picture_answer(const RgbImage& image) {
  const int shift = image.depth - 8;
  std::string bytes(4 * size_t{image.width} * image.height, '\xff');
  const uint16_t* in = image.samples.data();
  for (char* out = bytes.data(); out != bytes.data() + bytes.size(); out += 4, in += 3) {
    for (size_t k = 0; k < 3; ++k) out[k] = static_cast<char>(in[k] >> shift);
  }
  return {.type = "application/octet-stream",
          .body = std::move(bytes),
          .headers = {{"Picture-Size", fmt::format("{},{}", image.width, image.height)}}};
}

Response other_picture(const cli::StreamFile& file, const Query& query, bool difference,
                       const std::function<RgbImage(ViewPos)>& other) {
  int32_t gain = 4;
  const PlaneRequest request = read_plane_request(query, false, [&](CLI::App& app, PlaneRequest&) {
    if (difference) cli::add_integer(app, "--gain", gain, 1, 64, "");
  });
  stop_level(file, request);
  const RgbImage image = other(*request.view);
  if (!difference) return picture_answer(image);
  const RgbImage golden = decoded(file, request);
  return picture_answer(
      cli::value_or_throw(io::difference_picture(image, golden, gain), cli::ExitCode::kInput));
}

uint32_t block_pixels(const StreamHeader& header, Plane plane) {
  const bool half = plane != Plane::kY && header.chroma_format == ChromaFormat::k420;
  return header.block_size() << (half ? 1 : 0);
}

}  // namespace hmlfc::view
