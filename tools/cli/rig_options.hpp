// The rig of a stream: which one `encode` writes, and what `info` says of it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <hmlfc/format.hpp>

#include "cli/commands.hpp"
#include "cli/output.hpp"
#include "cli/view_source.hpp"
#include "io/stream_rig.hpp"
#include "io/view_list.hpp"

namespace hmlfc::cli {

/// The values of --rig and --no-rig.
struct RigOptions {
  std::optional<std::filesystem::path> file;
  bool none = false;
};

/// Adds --rig and --no-rig.
void add_rig_options(CLI::App& app, RigOptions& options);

using io::ChosenRig;

/// The rig for `views`: that of --rig, else, where `profile` is extended, that which lies beside
/// them, else that of file names that state positions. Failures: --rig with profile main (kUsage);
/// a file that holds no rig of these views (kInput).
std::optional<ChosenRig> rig_for(const RigOptions& options, Profile profile,
                                 const io::ViewList& views, const LightFieldShape& shape);

/// "Rig           ...": the cameras of `file` in a line for people; what is wrong with a rig that
/// cannot be read; "" without one.
std::string rig_line(const StreamFile& file);

/// Throws Failure, kCorrupt, where `file` has a rig that cannot be read.
void check_rig(const StreamFile& file);

/// The rig of `file`, nothing without one; one that cannot be read is noted and left out.
std::optional<ChosenRig> rig_in(const StreamFile& file);

/// The text of the rig of `file`. Failure (kInput): it has none, or one that cannot be read.
std::string rig_text_of(const StreamFile& file);

}  // namespace hmlfc::cli
