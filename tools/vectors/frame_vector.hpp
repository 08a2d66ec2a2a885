// Makes the frames and maps of the suite, with what the golden model says of them.
#pragma once

#include <string>
#include <vector>

#include "vectors/generate.hpp"
#include "vectors/manifest.hpp"

namespace hmlfc::vectors {

/// What must come of `frame`, whose camera and stop level, or whose map's view, are set: sets the
/// rest of it. Throws TextError where the golden and the fast renderer differ, or the stop level or
/// the view is not the stream's.
Expectation expect_frame(const Decoder& decoder, FrameCase& frame);

/// The vector `id` of this recipe (vectors/README.md, recipes), on one of the streams in `files`,
/// which `vectors` have. Throws TextError where the recipe cannot be read or the golden model
/// contradicts it, and as expect_frame does.
Vector make_frame_vector(const std::string& id, const Json& recipe,
                         const std::vector<Vector>& vectors, const SuiteFiles& files);

}  // namespace hmlfc::vectors
