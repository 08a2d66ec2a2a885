// Encoding all images of one level in profile extended.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <hmlfc/encoder.hpp>
#include <hmlfc/light_field.hpp>

#include "encoder/disparity_search.hpp"
#include "encoder/level_encoder.hpp"
#include "encoder/residual_choice.hpp"
#include "encoder/rkv_tree.hpp"
#include "syntax/geometry.hpp"

namespace hmlfc {

/// The tiles of one image: three planes, then the motion plane.
using ExtendedImageCode = std::array<PlaneCode, kPlaneCount + 1>;

/// The key images' codestreams and the CRCs of their samples, in the order of KEY-1.
struct CodedKeys {
  std::vector<std::vector<uint8_t>> codestreams;
  std::vector<uint32_t> crcs;
};

/// How much is tried.
struct ExtendedEffort {
  unsigned choices = 9;       ///< of MotionTask
  unsigned steps_around = 1;  ///< of ResidualRules
};

/// How good a plane has to be.
struct PlaneTarget {
  ResidualRules residuals;
  double key_error = 0;  ///< mean squared error of key images; 0 means lossless
};

/// What a level's encoding needs and what it leaves behind.
struct ExtendedLevelTask {
  const LightField* light_field = nullptr;
  const StreamHeader* header = nullptr;
  const Geometry* geometry = nullptr;
  int level = 0;
  std::array<PlaneTarget, kPlaneCount> targets{};
  Lambda motion_lambda;
  ExtendedEffort effort;
  DisparityRange disparities;  ///< tried at level 0
  RkvTree* tree = nullptr;     ///< levels above `level` reconstructed, `level` original
  std::vector<ExtendedImageCode>* codes = nullptr;  ///< by image number
  CodedKeys* keys = nullptr;
  ErrorSums* error = nullptr;  ///< of the views, written at level 0
  const EncodeObserver* observer = nullptr;
};

/// Encodes the level's reference images, then the disparities of its groups, then its predictive
/// images. Above level 0 the tree's images of the level become the reconstructed ones.
void encode_extended_level(const ExtendedLevelTask& task);

}  // namespace hmlfc
