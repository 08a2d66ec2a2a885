// The plan of an encoding that several machines share.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <hmlfc/divided_encoder.hpp>

#include "cli/encode_outcome.hpp"
#include "io/view_list.hpp"

namespace hmlfc::cli {

/// What a plan says first.
inline constexpr std::string_view kPlanSign = "hmlfc encode plan 1";

/// Everything that the bytes of the stream depend on.
struct EncodePlan {
  EncodeOptions options;  ///< the views and the rig; paths are absolute
  EncodeParams params;    ///< settled
  PartGrid parts;
  std::string id;  ///< SHA-256 of the plan's text
};

/// The text of a plan, for views `list`.
std::string plan_text(const EncodeOptions& options, const EncodeParams& params,
                      const PartGrid& parts, const io::ViewList& list);

/// Reads `file`. Failures (kInput): it is no plan, it is of another version of this program, or
/// views are missing or have another size now.
EncodePlan read_plan(const std::filesystem::path& file);

}  // namespace hmlfc::cli
