// Rendering by hmlfc.h.
#include <hmlfc/renderer.hpp>

#include <algorithm>
#include <array>
#include <memory>

#include <hmlfc/hmlfc.h>
#include <hmlfc/camera.hpp>

#include "capi/handles.hpp"
#include "capi/outcome.hpp"
#include "capi/pixels.hpp"
#include "capi/structs.hpp"

struct hmlfc_renderer {
  std::shared_ptr<const hmlfc::capi::OpenedStream> stream;
  std::unique_ptr<hmlfc::FrameRenderer> renderer;
  hmlfc::Frame frame;
};

namespace hmlfc::capi {
namespace {

constexpr uint32_t kMostThreads = 65535;

tl::expected<RenderOptions, Refusal> read_render_options(const hmlfc_render_options* options) {
  const auto given = read_options(options, &hmlfc_render_options::reserved, "options");
  if (!given) return tl::unexpected(given.error());
  if (given->threads > kMostThreads) return bad_argument("options", "has threads above 65535");
  if (given->reserved != 0) return bad_argument("options", "has a value in reserved");
  RenderOptions read;
  const auto cache_bytes = std::min<uint64_t>(given->cache_bytes, SIZE_MAX);
  if (cache_bytes != 0) read.cache_bytes = static_cast<size_t>(cache_bytes);
  read.threads = static_cast<int>(given->threads);
  return read;
}

Outcome open_renderer(const hmlfc_decoder* decoder, const hmlfc_render_options* options,
                      hmlfc_renderer** renderer) {
  if (auto ok = check_pointer(renderer, "renderer"); !ok) return ok;
  *renderer = nullptr;
  if (auto ok = check_pointer(decoder, "decoder"); !ok) return ok;
  const auto read = read_render_options(options);
  if (!read) return tl::unexpected(read.error());
  auto made = make_cpu_renderer(decoder->stream->decoder(), *read);
  *renderer = new hmlfc_renderer{decoder->stream, std::move(made), {}};
  return {};
}

WorldPoint point_of(const double (&values)[3]) { return {values[0], values[1], values[2]}; }

tl::expected<Camera, Refusal> read_camera(const hmlfc_camera& given, const StreamHeader& header) {
  constexpr std::array kFilters{Filter::kQuadrilinear, Filter::kViews, Filter::kNearest};
  const auto wrong = [](const char* what) { return bad_argument("camera", what); };
  if (given.has_position > 1) return wrong("has has_position above 1");
  if (given.has_look_at > 1) return wrong("has has_look_at above 1");
  if (given.filter >= kFilters.size()) return wrong("has an unknown filter");
  if (given.geometry > HMLFC_GEOMETRY_STREAM) return wrong("has an unknown geometry");
  Camera camera;
  if (given.frame_width != 0) camera.frame_width = given.frame_width;
  if (given.frame_height != 0) camera.frame_height = given.frame_height;
  if (given.has_position == 1) camera.position = point_of(given.position);
  if (given.has_look_at == 1) camera.look_at = point_of(given.look_at);
  if (given.focal != 0) camera.focal = given.focal;
  if (given.row_pitch != 0) camera.row_pitch = given.row_pitch;
  if (given.tan_half != 0) camera.tan_half = given.tan_half;
  camera.shear = given.shear;
  camera.focus = given.focus;
  camera.aperture = static_cast<int>(given.aperture);
  camera.filter = kFilters[given.filter];
  camera.geometry = suitable_geometry(header);
  if (given.geometry == HMLFC_GEOMETRY_PLANE) camera.geometry = GeometrySource::kPlane;
  if (given.geometry == HMLFC_GEOMETRY_STREAM) camera.geometry = GeometrySource::kStream;
  return camera;
}

Outcome render(hmlfc_renderer* renderer, const hmlfc_camera* camera, const hmlfc_pixels* pixels) {
  if (auto ok = check_pointer(renderer, "renderer"); !ok) return ok;
  const auto given = read_struct(camera, &hmlfc_camera::stop_level, "camera");
  if (!given) return tl::unexpected(given.error());
  const StreamHeader& header = renderer->stream->decoder().header();
  const auto read = read_camera(*given, header);
  if (!read) return tl::unexpected(read.error());
  const auto record = frame_record(*read, header);
  if (!record) return refuse(HMLFC_STATUS_BAD_CAMERA, record.error().message);
  const auto into = read_pixels(pixels, static_cast<uint32_t>(record->frame_width),
                                static_cast<uint32_t>(record->frame_height), header.depth);
  if (!into) return tl::unexpected(into.error());
  Frame& frame = renderer->frame;
  const auto rendered =
      renderer->renderer->render(*record, static_cast<int>(given->stop_level), frame);
  if (!rendered) return renderer->stream->refuse(rendered.error());
  store(frame.image, *into);
  return {};
}

}  // namespace
}  // namespace hmlfc::capi

namespace capi = hmlfc::capi;

int hmlfc_open_renderer(const hmlfc_decoder* decoder, const hmlfc_render_options* options,
                        hmlfc_renderer** renderer, hmlfc_failure* failure) {
  return capi::answer(failure, [&] { return capi::open_renderer(decoder, options, renderer); });
}

void hmlfc_close_renderer(hmlfc_renderer* renderer) { delete renderer; }

int hmlfc_render(hmlfc_renderer* renderer, const hmlfc_camera* camera, const hmlfc_pixels* pixels,
                 hmlfc_failure* failure) {
  return capi::answer(failure, [&] { return capi::render(renderer, camera, pixels); });
}
