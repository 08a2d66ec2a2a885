#include "view/plane_request.hpp"

#include "io/pictures.hpp"
#include "view/pixels.hpp"
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
