#include "view/frames.hpp"

#include <nlohmann/json.hpp>

#include "cli/camera_path.hpp"
#include "cli/outside_share.hpp"
#include "cli/render_trace.hpp"
#include "io/image_files.hpp"
#include "vectors/frame_case.hpp"
#include "view/plane_request.hpp"
#include "view/query.hpp"

namespace hmlfc::view {

using cli::ExitCode;
using cli::Failure;
using cli::Json;

namespace {

int stop_level_of(const LookQuery& look, const cli::StreamFile& file) {
  return look.levels ? file.stop_level(*look.levels) : 0;
}

}  // namespace

FrameRecord Frames::render(const Query& query) {
  const LookQuery look = read_look_query(query);
  const cli::StreamFile& file = stream_.for_frames();
  const Camera camera = cameras_of(look.cameras, file).cameras.front();
  const FrameRecord record = *frame_record(camera, file.header());  // cameras_of() has checked it
  const int stop_level = stop_level_of(look, file);
  if (renderer_ == nullptr) {
    renderer_ = make_cpu_renderer(file.decoder());
    if (looks_ahead_) prefetcher_.emplace(file.decoder());
  }
  stream_.touched().reset();
  file.value(renderer_->render(record, stop_level, frame_));
  if (prefetcher_) prefetcher_->rendered(record, stop_level);
  return record;
}

Response Frames::frame(const Query& query) {
  const std::lock_guard lock(mutex_);
  const FrameRecord record = render(query);
  const Json cost{{"width", frame_.image.width},
                  {"height", frame_.image.height},
                  {"seconds", frame_.seconds.total()},
                  {"needed", frame_.counts.blocks_needed},
                  {"decoded", frame_.counts.blocks_decoded},
                  {"reused", frame_.counts.blocks_reused},
                  {"touched", stream_.touched().bytes()},
                  {"key_samples", stream_.touched().key_samples()},
                  {"views", views_in_use(record)},
                  {"outside", cli::OutsideShare().add(record, frame_.image)}};
  Response response = picture_answer(frame_.image);
  response.headers.emplace_back("Frame", cost.dump());
  return response;
}

Response Frames::png(const Query& query) {
  const std::lock_guard lock(mutex_);
  render(query);
  const std::vector<uint8_t> bytes = io::encode_png(frame_.image);
  if (bytes.empty()) throw Failure(ExitCode::kOutOfMemory, "not enough memory for a PNG file");
  return {.type = "image/png",
          .body = {bytes.begin(), bytes.end()},
          .headers = {{"Content-Disposition", "attachment; filename=\"frame.png\""}}};
}

Response Frames::focus(const Query& query) const {
  const LookQuery look = read_look_query(query);
  if (!look.cameras.focus_at) throw Failure(ExitCode::kUsage, "focus-at is missing");
  const Camera camera = cameras_of(look.cameras, stream_.for_blocks()).cameras.front();
  return {.body = Json{{"focus", camera.focus}}.dump()};
}

Response Frames::trace(const Query& query) const {
  std::optional<cli::FramePixel> pixel;
  const LookQuery look =
      read_look_query(query, [&pixel](CLI::App& app) { cli::add_trace(app, pixel)->required(); });
  const cli::StreamFile& file = stream_.for_blocks();
  const Camera camera = cameras_of(look.cameras, file).cameras.front();
  Json json =
      trace_json(file, *frame_record(camera, file.header()), stop_level_of(look, file), *pixel);
  json["inputs"] = vectors::camera_words(camera);
  return {.body = json.dump()};
}

void Frames::finish_ahead() {
  const std::lock_guard lock(mutex_);
  if (prefetcher_) prefetcher_->finish();
}

}  // namespace hmlfc::view
