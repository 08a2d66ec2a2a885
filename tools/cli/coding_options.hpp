// The options of hmlfc encode that control the coding.
#pragma once

#include <optional>
#include <string_view>

#include <hmlfc/encoder.hpp>

#include "cli/commands.hpp"

namespace hmlfc::cli {

/// The values of the options. Complete after settle_coding_options.
struct CodingOptions {
  EncodeParams params;
  std::optional<double> target_psnr;  ///< dB over RGB
  std::optional<double> target_bpp;   ///< bits per pixel of all views
  std::optional<uint64_t> max_bytes;  ///< of the file
  std::optional<double> quality;      ///< [-64, 132]
};

/// "fast", "medium" or "slow".
std::string_view preset_name(Preset preset);

/// The target that was given, for a light field of `shape`; none: the quality counts.
std::optional<EncodeTarget> target_of(const CodingOptions& options, const LightFieldShape& shape);

/// Adds --profile, --quality, the targets, --lossless and the options of profiles and methods.
void add_coding_options(CLI::App& app, CodingOptions& options);

/// After parsing: refuses contradictory combinations (kUsage) and sets what depends on the profile.
void settle_coding_options(const CLI::App& app, CodingOptions& options);

}  // namespace hmlfc::cli
