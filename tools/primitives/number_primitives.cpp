// Numbers of images and tiles, reference groups and reference images.
#include <string>
#include <utility>

#include "primitives/primitive.hpp"
#include "syntax/geometry.hpp"
#include "syntax/index.hpp"

namespace hmlfc::primitives {
namespace {

// Of 4096 x 4096 views in clusters of 1 x 2 with 15 levels above them (specification, section 11).
constexpr int64_t kMaxImages = int64_t{4096} * 8194;

// A place among as many as the column `count` says.
Column below(std::string name, const std::string& count) {
  return {std::move(name), "[0, " + count + " - 1]", [count](const Inputs& in) {
            return Interval{0, int64_t{in[count]} - 1};
          }};
}

StreamHeader tree_of(const Inputs& in) {
  StreamHeader header;
  header.rows = in["rows"];
  header.cols = in["cols"];
  header.tree_height = in["tree_height"];
  header.cluster_rows = in["cluster_rows"];
  header.cluster_cols = in["cluster_cols"];
  header.levels.resize(static_cast<size_t>(header.tree_height) + 1);
  return header;
}

LevelShape level_of(const Inputs& in) { return Geometry(tree_of(in)).level(in["level"]); }

// A cluster has two images at least, where there is more than one level (FIL-1).
Interval cluster_cols_of(const Inputs& in) {
  const bool one_row = uint32_t{in["cluster_rows"]} == 1;
  return {one_row && int32_t{in["tree_height"]} > 0 ? 2 : 1, 255};
}

Primitive image_number() {
  return {
      "image-number",
      "IDX-1 STR-3",
      {within("rows", 1, kMaxGrid),
       within("cols", 1, kMaxGrid),
       within("tree_height", 0, kMaxTreeHeight),
       within("cluster_rows", 1, 255),
       {"cluster_cols", "[1, 255], not 1 with cluster_rows 1 and tree_height > 0", cluster_cols_of},
       {"level", "[0, tree_height]",
        [](const Inputs& in) {
          return Interval{0, int64_t{in["tree_height"]}};
        }},
       {"row", "[0, R_level - 1]",
        [](const Inputs& in) {
          return Interval{0, int64_t{level_of(in).rows} - 1};
        }},
       {"col", "[0, C_level - 1]",
        [](const Inputs& in) {
          return Interval{0, int64_t{level_of(in).cols} - 1};
        }}},
      {},
      "number",
      kDrawn,
      [](const Inputs& in) {
        return joined(Geometry(tree_of(in)).image_number(in["level"], {in["row"], in["col"]}));
      }};
}

Geometry planes_of(const Inputs& in) {
  StreamHeader header;
  header.levels.resize(1);
  header.width = in["width"];
  header.height = in["height"];
  header.chroma_format =
      uint32_t{in["chroma_format"]} == 0 ? ChromaFormat::k420 : ChromaFormat::k444;
  header.block_log2 = in["block_log2"];
  header.motion_tile_log2 = in["motion_tile_log2"];
  const uint32_t chroma_motion = in["chroma_motion"];
  if (header.motion_tile_log2 != 0) header.feature_flags = feature_bit(Feature::kMotionTiles);
  if (chroma_motion != 0) header.feature_flags |= feature_bit(Feature::kChromaMotion);
  return Geometry(header);
}

// Tiles in a row and in a column of the plane.
ImagePos tiles_of(const Inputs& in) {
  const Geometry geometry = planes_of(in);
  const size_t plane = in["plane"];
  if (plane < kPlaneCount) {
    const PlaneShape& shape = geometry.plane(kPlanes[plane]);
    return {shape.tiles_y, shape.tiles_x};
  }
  const MotionPlaneShape& shape = geometry.motion_planes()[plane - kPlaneCount];
  return {shape.tiles_y, shape.tiles_x};
}

std::string number_of_tile(const Inputs& in) {
  const Geometry geometry = planes_of(in);
  const size_t plane = in["plane"];
  const uint64_t tile =
      plane < kPlaneCount
          ? geometry.tile_number(in["image"], kPlanes[plane], in["tx"], in["ty"])
          : geometry.motion_tile_number(in["image"], plane - kPlaneCount, in["tx"], in["ty"]);
  return joined(tile, tile / kGroupTiles, tile % kGroupTiles);
}

Primitive tile_number() {
  const auto has_motion = [](const Inputs& in) { return uint32_t{in["motion_tiles"]} != 0; };
  return {"tile-number",
          "IDX-2 IDX-3 STR-6 MOT-1",
          {within("width", 1, kMaxSide),
           within("height", 1, kMaxSide),
           within("chroma_format", 0, 1),
           within("block_log2", 1, 3),
           within("motion_tiles", 0, 1),
           {"motion_tile_log2", "[5, 7], without motion_tiles 0",
            [=](const Inputs& in) {
              return has_motion(in) ? Interval{5, 7} : Interval{0, 0};
            }},
           {"chroma_motion", "[0, motion_tiles]",
            [](const Inputs& in) {
              return Interval{0, int64_t{in["motion_tiles"]}};
            }},
           within("image", 0, kMaxImages - 1),
           {"plane", "[0, 2 + motion_tiles + chroma_motion]",
            [](const Inputs& in) {
              return Interval{0, 2 + int64_t{in["motion_tiles"]} + int64_t{in["chroma_motion"]}};
            }},
           {"tx", "[0, t_p - 1]",
            [](const Inputs& in) {
              return Interval{0, int64_t{tiles_of(in).col} - 1};
            }},
           {"ty", "[0, T_p / t_p - 1]",
            [](const Inputs& in) {
              return Interval{0, int64_t{tiles_of(in).row} - 1};
            }}},
          {},
          "tile group place",
          kDrawn,
          number_of_tile};
}

Geometry one_level(ImagePos size, ImagePos group, bool balanced) {
  StreamHeader header;
  header.rows = size.row;
  header.cols = size.col;
  header.levels = {{narrow<uint8_t>(group.row), narrow<uint8_t>(group.col), 0}};
  if (balanced) header.feature_flags = feature_bit(Feature::kBalancedGroups);
  return Geometry(header);
}

std::string group_of_image(const Inputs& in) {
  const uint32_t balanced = in["balanced"];
  const Geometry geometry = one_level({in["images"], 1}, {in["group_size"], 1}, balanced != 0);
  const ImagePos image{in["image"], 0};
  return joined(geometry.group_of(0, image).row, geometry.reference_of(0, image).row);
}

Primitive reference_group(const std::string& name, int64_t max_images, int64_t max_size,
                          uint32_t drawn) {
  return {name,
          "STR-4 EXT-3",
          {within("balanced", 0, 1), within("images", 1, max_images),
           within("group_size", 1, max_size), below("image", "images")},
          {},
          "group reference_image",
          drawn,
          group_of_image};
}

std::string references_of_image(const Inputs& in) {
  const uint32_t balanced = in["balanced"];
  const Geometry geometry =
      one_level({in["rows"], in["cols"]}, {in["ref_rows"], in["ref_cols"]}, balanced != 0);
  const ReferenceImages images = reference_images(geometry, 0, {in["row"], in["col"]});
  const ReferenceSet set = references_of_set(in["reference_set"]);
  std::vector<uint32_t> places;
  for (unsigned i = 0; i < set.count; ++i) {
    const ImagePos image = images[set.reference[i]];
    places.insert(places.end(), {image.row, image.col});
  }
  return joined(places);
}

Primitive reference_images_of_set() {
  return {"references",
          "MOT-7 STR-4 EXT-3",
          {within("rows", 1, kMaxGrid), within("cols", 1, kMaxGrid), within("ref_rows", 1, 255),
           within("ref_cols", 1, 255), within("balanced", 0, 1), below("row", "rows"),
           below("col", "cols"), within("reference_set", 0, 7)},
          {},
          "row col, of one or two images",
          2 * kDrawn,
          references_of_image};
}

}  // namespace

std::vector<Primitive> number_primitives() {
  return {image_number(), tile_number(), reference_group("group-small", 16, 17, kAll),
          reference_group("group", kMaxGrid, 255, kDrawn), reference_images_of_set()};
}

}  // namespace hmlfc::primitives
