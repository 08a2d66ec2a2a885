// Synthetic light fields with real parallax, occlusion and reflections, the same on every machine.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include <hmlfc/light_field.hpp>

#include "io/parallel.hpp"

namespace hmlfc::scenes {

enum class Scene {
  kCards,    ///< playing cards and panels in the air over a cloth: planes at many depths
  kKnights,  ///< ranks of toy knights before a castle: many small occluders
  kGlass,    ///< glass and lacquered balls: refraction, reflection, highlights that move
  kFlat,     ///< a plain backdrop, equal in all views, and one small soft disc
  kNoise,    ///< uniform noise, independent in each view: the worst case of any codec
};

/// The scene of this name ("cards" ...), or nothing.
std::optional<Scene> scene_from_name(std::string_view name);

/// What to render.
///
/// A point at depth z (in the scene's unit of depth) moves by baseline_px * (1 / z - 1 / z_focus)
/// pixels from each view to the next, where z_focus is the depth of the scene's middle: nearer
/// points move to the left as the column rises and up as the row rises, as in light fields
/// photographed from left to right and from top to bottom.
struct SceneParams {
  Scene scene = Scene::kCards;
  uint32_t rows = 8;         ///< [1, 4096]
  uint32_t cols = 8;         ///< [1, 4096]
  uint32_t width = 512;      ///< pixels, [1, 65536]
  uint32_t height = 512;     ///< pixels, [1, 65536]
  double baseline_px = 2.0;  ///< parallax between neighbouring views at depth 1, [0, 64]
  uint64_t seed = 1;         ///< varies positions, colours and textures; "flat" ignores it
  int depth = 8;             ///< bits per sample, [8, 12]
};

/// Renders all views on `threads` threads (0: all cores). The result depends only on `params`, not
/// on threads or machine: the renderer uses the IEEE operations + - * / and sqrt in double
/// precision, without fused multiply-add, and an integer hash for random numbers. Throws
/// std::bad_alloc if the light field does not fit in memory.
LightField render_scene(const SceneParams& params, unsigned threads,
                        const io::Progress& progress = {});

}  // namespace hmlfc::scenes
