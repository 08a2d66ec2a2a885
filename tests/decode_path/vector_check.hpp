// Whether the decode path does with a vector what the manifest says, by every way of decoding.
#pragma once

#include <filesystem>
#include <string>

#include "vectors/manifest.hpp"

namespace hmlfc::vectors {

/// What is wrong with `vector` of the suite in `folder`, or an empty text. Compared with the
/// manifest: the outcome, the error and its place, all views, the checksums of all blocks, traces.
/// Compared with each other: single blocks with reference images on demand
/// and kept, whole planes and levels put on one another, at every stop level; single views and all
/// of them at once; parts of views. Requests for what a stream does not have must be refused.
std::string check_vector(const std::filesystem::path& folder, const Vector& vector);

}  // namespace hmlfc::vectors
