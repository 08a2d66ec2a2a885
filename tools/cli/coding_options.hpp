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
  std::optional<double> quality;      ///< [0, 100]
};

/// "fast", "medium" or "slow".
std::string_view preset_name(Preset preset);

/// Adds --profile, --quality, --target-psnr, --lossless and the options of profiles and methods.
void add_coding_options(CLI::App& app, CodingOptions& options);

/// After parsing: refuses contradictory combinations (kUsage) and sets what depends on the profile.
void settle_coding_options(const CLI::App& app, CodingOptions& options);

}  // namespace hmlfc::cli
