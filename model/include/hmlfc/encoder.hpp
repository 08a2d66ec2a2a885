// The encoder: a light field in, a stream out.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <variant>
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

/// How long the encoder of profile extended may search.
enum class Preset : uint8_t { kFast, kMedium, kSlow };

/// Parameters of profile main alone. Blocks whose energy, the sum of absolute differences from the
/// prediction, is below a threshold are dropped.
struct MainParams {
  uint32_t threshold_ref = 75;   ///< of reference images
  uint32_t threshold_pred = 75;  ///< of predictive images
  /// Weighs squared errors against bits instead: with threshold T, a bit of a view is worth T^2 /
  /// 256 of squared error. 0 still keeps every sample.
  bool rate_distortion = false;
};

/// The lowest quality of samples of `depth` bits, [8, 12]: quality counts in steps of a sample.
constexpr double lowest_quality(int depth) { return 16.0 * (8 - depth); }

inline constexpr double kHighestQuality = 132;

/// The threshold that stands for `quality` in [-64, 132]: 75 for 60, twice that for every 10 below.
inline uint32_t threshold_of_quality(double quality) {
  return static_cast<uint32_t>(std::lround(75 * std::exp2((60 - quality) / 10)));
}

/// Parameters of profile extended alone.
struct ExtendedParams {
  double quality = 60;  ///< [lowest_quality(), kHighestQuality]; higher is better and larger
  Preset preset = Preset::kMedium;  ///< how long to search
  /// Samples a side for which a reference group has one disparity: 4 or 8, at least block_size, or
  /// open with 0: found by trial.
  unsigned disparity_grid = 0;
};

/// How to encode. The intervals are those of the header (specification, section 3). What is left
/// open takes a value that depends on the profile.
struct EncodeParams {
  Profile profile = Profile::kExtended;  ///< the set of tools
  Method method = Method::kHmlfc;        ///< the codec
  uint32_t cluster_rows = 2;             ///< [1, 255]
  uint32_t cluster_cols = 2;             ///< [1, 255]
  /// [0, 15], lowered to what the grid needs; 0 for kMc. Open: main and kRlfc 3, extended 0.
  std::optional<int> tree_height = {};
  unsigned block_size = 4;  ///< 2, 4 or 8
  /// [0, 127]. Open: main 16, extended 64.
  std::optional<int> window = {};
  /// Reference groups of every level with motion: [1, 255], or open with 0: main 8, extended found
  /// by trial.
  uint32_t ref_rows = 0;
  uint32_t ref_cols = 0;  ///< likewise
  /// Size of Co and Cg. Open: main 4:2:0, extended and for a PSNR chosen by its cost, lossless
  /// 4:4:4.
  std::optional<ChromaFormat> chroma = {};
  /// Keeps every sample, and with 4:4:4 every RGB value. Thresholds and quality have no meaning.
  bool lossless = false;
  int threads = 0;               ///< 0: all cores; never changes the result
  MainParams main = {};          ///< used in profile main
  ExtendedParams extended = {};  ///< used in profile extended
};

/// An encoded stream with what the encoder knows about it.
struct EncodedStream {
  std::vector<uint8_t> bytes;  ///< the whole file
  ErrorSums error;             ///< of the encoder's own reconstruction, which a decoder's equals
  EncodeParams params;         ///< those used: nothing is open
};

/// Human-readable reason why encoding failed.
struct EncodeError {
  std::string message;         ///< one line
  bool out_of_memory = false;  ///< nothing is wrong with what was given
};

/// Called with the number of finished images `done` in [0, total], from one thread at a time: 0 as
/// long as parameters are settled by trial. What it throws ends the encoding, and is thrown again.
using Progress = std::function<void(uint64_t done, uint64_t total)>;

/// What trials expect an encoding to take, here and now.
struct EncodeForecast {
  double seconds = 0;  ///< from the end of trials on
  double bytes = 0;    ///< of the stream without a rig
};

/// Called once, after trials: not in profile main, nor where nothing is left to them.
using ForecastSink = std::function<void(const EncodeForecast& forecast)>;

/// Encodes `light_field`. The result is the same bytes for any number of threads and any
/// instruction set. Errors: a parameter outside its interval, out of memory.
HMLFC_EXPORT tl::expected<EncodedStream, EncodeError> encode(const LightField& light_field,
                                                             const EncodeParams& params,
                                                             const Progress& progress = {},
                                                             const ForecastSink& forecast = {});

/// Whether views are predicted far better with rows taken for columns: files may have been taken in
/// the wrong order. `threads` as in EncodeParams. Throws std::bad_alloc.
HMLFC_EXPORT bool seems_transposed(const LightField& light_field, int threads = 0);

/// The least PSNR over RGB.
struct TargetPsnr {
  double db = 0;  ///< [1, 100]
  friend bool operator==(const TargetPsnr&, const TargetPsnr&) = default;
};

/// The most bytes of the whole stream.
struct TargetBytes {
  uint64_t bytes = 0;  ///< at least 1
  friend bool operator==(const TargetBytes&, const TargetBytes&) = default;
};

using EncodeTarget = std::variant<TargetPsnr, TargetBytes>;

/// Encodes with the lowest quality, in eighths (in profile main: with the largest thresholds, both
/// equal), whose PSNR is at least that of `target`, or with the highest that takes no more bytes
/// than `target` has. For a PSNR, in profile extended, the quality of the result is that of its key
/// images, and predicted views have others, at most 4 away. A result within 0.03 dB or two percent
/// of the bytes is near enough. Where no quality meets the target (subsampled chroma limits the
/// PSNR, key images take bytes), the result is the nearest there is. The first quality tried is the
/// one that trials predict, the first threshold threshold_pred of `params`. params.lossless is
/// ignored.
HMLFC_EXPORT tl::expected<EncodedStream, EncodeError> encode_to(const LightField& light_field,
                                                                const EncodeParams& params,
                                                                const EncodeTarget& target,
                                                                const Progress& progress = {},
                                                                const ForecastSink& forecast = {});

}  // namespace hmlfc
