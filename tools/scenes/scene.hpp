// Synthetic light fields with real parallax, occlusion and reflections, the same on every machine.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>

#include <hmlfc/image.hpp>
#include <hmlfc/light_field.hpp>
#include <hmlfc/rig.hpp>

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

/// Where the cameras of the views stand.
enum class Cameras {
  kGrid,    ///< on a regular grid in a plane, parallel, sheared to the plane of the scene's middle
  kPlane,   ///< the same, each off its place by up to 0.35 steps of the grid each way
  kSphere,  ///< the grid as seen from the scene's middle, on a sphere around it; turned to it
  kPath,    ///< row by row along a wave through space as long as all steps; turned to the middle
};

/// What to render.
///
/// A point at depth z (in the scene's unit of depth) moves by baseline_px * (1 / z - 1 / z_focus)
/// pixels from each view to the next, where z_focus is the depth of the scene's middle: nearer
/// points move to the left as the column rises and up as the row rises, as in light fields
/// photographed from left to right and from top to bottom. Cameras that are not on the grid have
/// the same distance of neighbours, roughly.
struct SceneParams {
  Scene scene = Scene::kCards;
  uint32_t rows = 8;                 ///< [1, 4096]
  uint32_t cols = 8;                 ///< [1, 4096]
  uint32_t width = 512;              ///< pixels, [1, 65536]
  uint32_t height = 512;             ///< pixels, [1, 65536]
  double baseline_px = 2.0;          ///< parallax between neighbouring views at depth 1, [0, 64]
  uint64_t seed = 1;                 ///< varies positions, colours and textures; "flat" ignores it
  int depth = 8;                     ///< bits per sample, [8, 12]
  Cameras cameras = Cameras::kGrid;  ///< "flat" and "noise" have kGrid alone
};

/// Gives the picture of view (row, col); several threads may call it at once. It depends only on
/// the scene's parameters, not on threads or machine: the renderer uses the IEEE operations + - * /
/// and sqrt in double precision, without fused multiply-add, and an integer hash for random
/// numbers.
using ViewRenderer = std::function<RgbImage(uint32_t row, uint32_t col)>;

/// The renderer of the views of a scene.
ViewRenderer view_renderer(const SceneParams& params);

/// Renders all views by view_renderer() on `threads` threads (0: all cores). Throws std::bad_alloc
/// if the light field does not fit in memory.
LightField render_scene(const SceneParams& params, unsigned threads,
                        const io::Progress& progress = {});

/// Receives the disparities of one view, row by row; called by several threads at once.
using DisparityConsumer =
    std::function<void(uint32_t row, uint32_t col, std::span<const float> pixels)>;

/// Gives `consumer` the disparities of every view: of each pixel by how many pixels what is seen in
/// its middle moves from a column to the next, baseline_px * (1 / z_focus - 1 / z), negative where
/// it is nearer than the middle; of glass and mirrors that of their surface. False, and nothing is
/// given, where the scene has none ("noise", cameras that are not on the grid).
bool render_disparities(const SceneParams& params, unsigned threads, const io::Progress& progress,
                        const DisparityConsumer& consumer);

/// Where the cameras of all views stand (RIG-2), in the scene's units. Nothing where pictures are
/// not taken by cameras ("flat", "noise").
std::optional<Rig> scene_rig(const SceneParams& params);

}  // namespace hmlfc::scenes
