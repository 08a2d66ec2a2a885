// The encoder: a light field in, a stream out.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include <hmlfc/export.hpp>
#include <hmlfc/format.hpp>
#include <hmlfc/light_field.hpp>
#include <hmlfc/measure.hpp>

namespace hmlfc {

/// The codecs that can be compared, from one set of tools (paper, section "Evaluation").
enum class Method : uint8_t {
  kHmlfc,  ///< tree and phase-shifted motion
  kRlfc,   ///< tree without motion
  kMc,     ///< motion of one sign from key views, without a tree (after Zhang and Li)
};

/// How long the encoder of profile extended may look.
enum class Preset : uint8_t { kFast, kMedium, kSlow };

/// How to encode. The intervals are those of the header (specification, section 3).
struct EncodeParams {
  Profile profile = Profile::kMain;  ///< the set of tools
  Method method = Method::kHmlfc;    ///< the codec
  uint32_t cluster_rows = 2;         ///< [1, 255]
  uint32_t cluster_cols = 2;         ///< [1, 255]
  int tree_height = 3;               ///< [0, 15]; lowered to what the grid needs; 0 for kMc
  unsigned block_size = 4;           ///< 2, 4 or 8
  int window = 16;                   ///< [0, 127]
  uint32_t ref_rows = 8;  ///< reference groups of every level with motion, [1, 255]; 0 in
                          ///< profile extended: found by trial
  uint32_t ref_cols = 8;  ///< [1, 255]
  ChromaFormat chroma = ChromaFormat::k420;  ///< size of Co and Cg
  bool automatic_chroma = false;    ///< of profile extended: choose the chroma format by its cost
  uint32_t threshold_ref = 75;      ///< blocks of reference images below this energy are dropped
  uint32_t threshold_pred = 75;     ///< the same for predictive images
  double quality = 60;              ///< of profile extended, [0, 100]
  Preset preset = Preset::kMedium;  ///< of profile extended
  bool lossless = false;  ///< of profile extended: every sample is kept, needs 4:4:4 to keep RGB
  int threads = 0;        ///< 0: all cores; never changes the result
};

/// An encoded stream with what the encoder knows about it.
struct EncodedStream {
  std::vector<uint8_t> bytes;  ///< the whole file
  ErrorSums error;             ///< of the encoder's own reconstruction, which a decoder's equals
  EncodeParams params;         ///< with what the encoder chose
};

/// Why nothing was encoded, for people.
struct EncodeError {
  std::string message;  ///< one line
};

/// Called with done in [0, total] as work proceeds, from one thread at a time.
using Progress = std::function<void(uint64_t done, uint64_t total)>;

/// Encodes `light_field`. The result is the same bytes for any number of threads and any
/// instruction set. Errors: a parameter outside its interval, out of memory.
HMLFC_EXPORT tl::expected<EncodedStream, EncodeError> encode(const LightField& light_field,
                                                             const EncodeParams& params,
                                                             const Progress& progress = {});

/// Encodes with the largest thresholds (both equal) whose PSNR over RGB is at least `target_db`, in
/// [1, 100]. If even thresholds of 0 do not reach it, because of subsampled chroma, the
/// result is that of thresholds 0.
HMLFC_EXPORT tl::expected<EncodedStream, EncodeError> encode_to_psnr(const LightField& light_field,
                                                                     const EncodeParams& params,
                                                                     double target_db,
                                                                     const Progress& progress = {});

}  // namespace hmlfc
