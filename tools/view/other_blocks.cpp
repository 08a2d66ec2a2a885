#include "view/other_blocks.hpp"

#include <nlohmann/json.hpp>

#include "cli/block_request.hpp"
#include "conform/difference.hpp"
#include "view/plane_request.hpp"
#include "view/query.hpp"

namespace hmlfc::view {

using cli::ExitCode;
using cli::Json;

namespace {

// Values of a block as rows of `side`.
Json rows_json(const std::vector<int32_t>& values, uint32_t side) {
  Json rows = Json::array();
  for (size_t at = 0; at + side <= values.size(); at += side) {
    rows.push_back(std::vector<int32_t>(values.begin() + static_cast<ptrdiff_t>(at),
                                        values.begin() + static_cast<ptrdiff_t>(at + side)));
  }
  return rows;
}

// The pixels of a block, `side` a side, that lie in the view.
Json pixels_json(const RgbImage& image, uint32_t bx, uint32_t by, uint32_t side) {
  Json rows = Json::array();
  for (uint32_t y = by * side; y < std::min(image.height, (by + 1) * side); ++y) {
    Json row = Json::array();
    for (uint32_t x = bx * side; x < std::min(image.width, (bx + 1) * side); ++x) {
      const uint16_t* pixel = image.samples.data() + 3 * (size_t{y} * image.width + x);
      row.push_back({pixel[0], pixel[1], pixel[2]});
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

Response OtherBlocks::picture(const Query& query, bool difference) {
  return other_picture(stream_.for_blocks(), query, difference,
                       [this](ViewPos view) { return other_.view(view); });
}

Response OtherBlocks::blocks(const Query& query) {
  const PlaneRequest request = read_plane_request(query, true);
  const cli::StreamFile& file = stream_.for_blocks();
  const RgbImage golden = decoded(file, request);
  const auto map = conform::compare_blocks(golden, other_.view(*request.view),
                                           block_pixels(file.header(), request.plane));
  return {.body = Json{{"worst", map.worst}}.dump()};
}

Response OtherBlocks::block(const Query& query) {
  cli::BlockRequest request;
  read_query(query, [&request](CLI::App& app) { add_block_options(app, request); });
  const cli::StreamFile& file = stream_.for_blocks();
  check_place(file, request);
  const auto [bx, by] = request.block;
  const BlockAddress block{*request.view, request.plane, bx, by};
  const int level = request.levels ? file.stop_level(*request.levels) : 0;
  Json json{{"name", other_.name()}, {"stages", Json::array()}, {"pixels", nullptr}};
  const uint32_t side = file.header().block_size();
  for (const auto& stage : other_.stages(block, level)) {
    if (stage.site.bx != bx || stage.site.by != by || stage.site.plane != request.plane) continue;
    json["stages"].push_back(
        {{"level", stage.site.level},
         {"image", {{"row", stage.site.image_row}, {"col", stage.site.image_col}}},
         {"stage", stage.stage},
         {"values", rows_json(stage.values, side)}});
  }
  if (json["stages"].empty() && level == 0) {
    const uint32_t pixels = block_pixels(file.header(), request.plane);
    const RgbImage golden = file.value(file.decoder().decode_view(*request.view));
    json["pixels"] = pixels_json(other_.view(*request.view), bx, by, pixels);
    json["golden"] = pixels_json(golden, bx, by, pixels);
  }
  return {.body = json.dump()};
}

}  // namespace hmlfc::view
