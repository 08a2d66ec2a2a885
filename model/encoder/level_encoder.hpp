// Encoding all images of one level of the tree.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include <hmlfc/encoder.hpp>
#include <hmlfc/light_field.hpp>

#include "encoder/plane_encoder.hpp"
#include "encoder/rkv_tree.hpp"
#include "syntax/geometry.hpp"

namespace hmlfc {

/// The three planes of one image; empty for a key image.
using ImageCode = std::array<PlaneCode, kPlaneCount>;

/// Who watches an encoder at work; both may be empty. Called by several threads at once.
struct EncodeObserver {
  std::function<void()> image_done;
  /// What a decoder will make of image `at` of level `level`, key images too.
  std::function<void(int level, ImagePos at, const ImagePlanes&)> reconstructed;
};

/// What a level's encoding needs and what it leaves behind.
struct LevelTask {
  const LightField* light_field = nullptr;
  const Geometry* geometry = nullptr;
  const EncodeParams* params = nullptr;
  int window = 0;
  int level = 0;
  RkvTree* tree = nullptr;  ///< levels above `level` reconstructed, `level` original
  std::vector<ImageCode>* codes = nullptr;  ///< by image number; this level's entries are written
  ErrorSums* error = nullptr;               ///< of the views, written at level 0
  const EncodeObserver* observer = nullptr;
};

/// Encodes each reference group: its reference image first, then the predictive images from its
/// reconstruction. Above level 0 the tree's images of the level become the reconstructed ones.
void encode_level(const LevelTask& task);

}  // namespace hmlfc
