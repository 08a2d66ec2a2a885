// What hmlfc render --json says of a frame.
#pragma once

#include <string>

#include <hmlfc/camera.hpp>
#include <hmlfc/renderer.hpp>

#include "cli/output.hpp"
#include "cli/view_source.hpp"

namespace hmlfc::cli {

/// The inputs of `camera`, which has them all (with_defaults()), that differ along a path.
Json camera_json(const Camera& camera);

/// The cost of one pass, drawn with `levels` levels of the tree into the file `name`. `touched` is
/// null for a device, which holds the whole stream in its memory.
Json pass_json(const std::string& name, int levels, const Frame& frame,
               const TouchedBytes* touched);

}  // namespace hmlfc::cli
