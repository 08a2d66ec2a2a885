#include "view/blocks.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

#include <hmlfc/disparity.hpp>
#include <hmlfc/measure.hpp>

#include "cli/arguments.hpp"
#include "cli/block_request.hpp"
#include "syntax/geometry.hpp"
#include "view/block_page.hpp"
#include "view/plane_request.hpp"
#include "view/query.hpp"

namespace hmlfc::view {

using cli::ExitCode;
using cli::Failure;
using cli::Json;

namespace {

constexpr size_t kKeptTraces = 4;

const cli::ViewSource& original_of(const OpenStream& stream) {
  if (stream.original() != nullptr) return *stream.original();
  throw Failure(ExitCode::kUsage, "there is no original; start with --original FOLDER");
}

// The pixels of `rect` of `image`.
RgbImage cut(const RgbImage& image, const Rect& rect) {
  RgbImage part{rect.width, rect.height, image.depth, {}};
  for (uint32_t y = rect.y; y < rect.y + rect.height; ++y) {
    const auto row = image.samples.begin() + 3 * (ptrdiff_t{y} * image.width + rect.x);
    part.samples.insert(part.samples.end(), row, row + 3 * ptrdiff_t{rect.width});
  }
  return part;
}

// PSNR over RGB of the pixels of each block, in dB; null where they are equal.
Json psnr_of_blocks(const PlaneTrace& trace, const RgbImage& a, const RgbImage& b, uint32_t side) {
  Json all = Json::array();
  for (uint32_t by = 0; by < trace.rows; ++by) {
    for (uint32_t bx = 0; bx < trace.columns; ++bx) {
      const Rect rect{bx * side, by * side, std::min(side, a.width - bx * side),
                      std::min(side, a.height - by * side)};
      const ErrorSums sums = measure(cut(a, rect), cut(b, rect));
      const double db = psnr(sums.rgb_squares, uint64_t{3} * rect.width * rect.height, a.depth);
      all.push_back(std::isinf(db) ? Json(nullptr) : Json(std::round(db * 100) / 100));
    }
  }
  return all;
}

// In pixels a column; null where the stream says nothing, or for the whole view where it is
// corrupt.
Json disparities_of_blocks(const Decoder& decoder, ViewPos view) {
  const auto map = disparity_map(decoder, view);
  if (!map) return nullptr;
  Json all = Json::array();
  for (const BlockDisparity& block : map->blocks) {
    const bool known = block.confidence > 0;
    all.push_back(known ? Json(static_cast<double>(block.disparity) / kDisparityUnits) : nullptr);
  }
  return all;
}

// The number of the plane's first tile (IDX-2).
uint64_t first_tile(const StreamHeader& header, const PlaneRequest& request, int level) {
  const Geometry geometry(header);
  const ImagePos image = geometry.ancestor({request.view->row, request.view->col}, 0, level);
  return geometry.tile_number(geometry.image_number(level, image), request.plane, 0, 0);
}

Json trace_json(const PlaneTrace& trace) {
  Json vectors = Json::array();
  for (const PlaneVector& v : trace.vectors) {
    vectors.push_back({v.block, v.image_row, v.image_col, v.x / 8.0, v.y / 8.0});
  }
  Json errors = Json::array();
  for (const PlaneError& error : trace.errors) errors.push_back({error.block, error.text});
  return {{"width", trace.size.width},  {"height", trace.size.height},
          {"columns", trace.columns},   {"rows", trace.rows},
          {"states", trace.states},     {"bits", trace.bits},
          {"read", trace.read},         {"level_counts", trace.level_counts},
          {"steps", trace.steps},       {"vectors", std::move(vectors)},
          {"errors", std::move(errors)}};
}

}  // namespace

std::shared_ptr<const PlaneTrace> Blocks::trace(const Key& key) {
  const std::lock_guard lock(mutex_);
  const auto found = std::ranges::find(kept_, key, &Kept::key);
  if (found != kept_.end()) return found->trace;
  const auto& [row, col, plane, level] = key;
  const cli::StreamFile& file = stream_.for_blocks();
  const Decoder& decoder = file.decoder();
  const PlaneSize size = decoder.plane_size(plane);
  if (uint64_t{size.width} * size.height > kMaxTracedSamples) {
    throw Failure(ExitCode::kInput,
                  "this plane has too many samples to look into all of it; hmlfc inspect shows a "
                  "block");
  }
  // Block by block, each would wait for the server.
  if (file.is_remote()) static_cast<void>(decoder.decode_plane({row, col}, plane, level));
  auto made = std::make_shared<const PlaneTrace>(trace_plane(decoder, {row, col}, plane, level));
  file.check_readable();
  kept_.push_back({key, made});
  if (kept_.size() > kKeptTraces) kept_.pop_front();
  return made;
}

Response Blocks::picture(const Query& query) const {
  const PlaneRequest request = read_plane_request(query, false);
  return picture_answer(decoded(stream_.for_blocks(), request));
}

Response Blocks::original(const Query& query, bool difference) const {
  return other_picture(stream_.for_blocks(), query, difference,
                       [this](ViewPos view) { return original_of(stream_).view(view); });
}

Response Blocks::stage(const Query& query) {
  size_t stage = 0;
  const PlaneRequest request = read_plane_request(query, true, [&](CLI::App& app, PlaneRequest&) {
    std::vector<std::pair<std::string, size_t>> names;
    for (size_t k = 0; k < kStageNames.size(); ++k) names.emplace_back(kStageNames[k], k);
    cli::add_choice(app, "--stage", stage, std::move(names), "")->required();
  });
  const int level = stop_level(stream_.for_blocks(), request);
  const auto traced = trace({request.view->row, request.view->col, request.plane, level});
  const std::vector<int16_t>& samples = traced->stages[stage];
  Response response{.type = "application/octet-stream"};
  for (const int16_t sample : samples) {
    response.body += {static_cast<char>(sample & 0xFF), static_cast<char>(sample >> 8)};
  }
  return response;
}

Response Blocks::blocks(const Query& query) {
  const PlaneRequest request = read_plane_request(query, true);
  const cli::StreamFile& file = stream_.for_blocks();
  const int level = stop_level(file, request);
  const auto traced = trace({request.view->row, request.view->col, request.plane, level});
  Json json = trace_json(*traced);
  json["first_tile"] = first_tile(file.header(), request, level);
  if (request.plane == Plane::kY && level == 0) {
    json["disparities"] = disparities_of_blocks(file.decoder(), *request.view);
    file.check_readable();
  }
  if (stream_.original() != nullptr && traced->errors.empty()) {
    json["psnr"] =
        psnr_of_blocks(*traced, stream_.original()->view(*request.view), decoded(file, request),
                       block_pixels(file.header(), request.plane));
  }
  return {.body = json.dump()};
}

Response Blocks::block(const Query& query) const {
  cli::BlockRequest request;
  read_query(query, [&request](CLI::App& app) { add_block_options(app, request); });
  const cli::StreamFile& file = stream_.for_blocks();
  cli::BlockReport report;
  const auto decoded = report_on_block(file, request, report);
  file.check_readable();
  Json json = block_page(report, file);
  json["error"] = decoded ? Json(nullptr) : Json(to_string(decoded.error()));
  return {.body = json.dump()};
}

}  // namespace hmlfc::view
