#version 450
#extension GL_GOOGLE_include_directive : require
// Areas of blocks to requests, one invocation a request.
#include "decode.glsl"
#include "requests.glsl"

#define AREA Area
#define AREAS arguments.areas
#define FIRST first_request
#include "area_search.glsl"

/// Whether the stream has the block.
bool exists(Area area, uvec2 block) {
  StreamShape shape = arguments.shape;
  if (area.level > shape.top || area.plane > 2u) return false;
  const LevelShape level = shape.levels[area.exact != 0u ? area.level : 0u];
  const PlaneShape plane = shape.planes[area.plane];
  return area.row < level.rows && area.col < level.cols && block.x < plane.blocks_x &&
         block.y < plane.blocks_y;
}

void main() {
  const uint number = invocation();
  if (number >= arguments.request_count) return;
  const Area area = area_of(number, arguments.area_count);
  const uint at = number - area.first_request;
  const uint row = at / area.columns;
  const uvec2 block = uvec2(area.bx + at - row * area.columns, area.by + row);
  Request request = Request(0u, 0u, 0u);
  if (exists(area, block)) {
    const uvec2 image = ancestor(uvec2(area.row, area.col), area.exact != 0u ? 0u : area.level);
    request.image = image.x | image.y << 16;
    request.block = block.x | block.y << 16;
    request.site = area.plane | area.level << 8 | 1u << 16;
  }
  arguments.requests.request[number] = request;
}
