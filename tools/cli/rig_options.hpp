// The rig of a stream: which one `encode` writes, and what `info` says of it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <hmlfc/format.hpp>
#include <hmlfc/rig.hpp>

#include "cli/commands.hpp"
#include "cli/output.hpp"
#include "cli/view_source.hpp"
#include "io/view_list.hpp"

namespace hmlfc::cli {

/// The values of --rig and --no-rig.
struct RigOptions {
  std::optional<std::filesystem::path> file;
  bool none = false;
};

/// Adds --rig and --no-rig.
void add_rig_options(CLI::App& app, RigOptions& options);

/// The rig that a stream gets.
struct ChosenRig {
  Rig rig;
  bool from_names = false;  ///< y grows with the rows; else it is what a file says
};

/// The rig for `views`: that of --rig, else, where `profile` is extended, that which lies beside
/// them, else that of file names that state positions. Failures: --rig with profile main (kUsage);
/// a file that holds no rig of these views (kInput).
std::optional<ChosenRig> rig_for(const RigOptions& options, Profile profile,
                                 const io::ViewList& views, const LightFieldShape& shape);

/// The most bytes by which stream_with_rig() makes a stream longer.
uint64_t most_rig_bytes(const ChosenRig& rig);

/// The section RIG of a stream with `header`. Where row_scale is negative, its rows go against the
/// pixels' y (CAM-2), and y of positions from file names with them.
std::string rig_section(const StreamHeader& header, const ChosenRig& rig);

/// The stream `bytes` with `rig`.
std::vector<uint8_t> stream_with_rig(std::span<const uint8_t> bytes, const ChosenRig& rig);

/// "Rig           ...": the cameras of `file` in a line for people; what is wrong with a rig that
/// cannot be read; "" without one.
std::string rig_line(const StreamFile& file);

/// For info --json: the rig as an object, {"error": what is wrong}, or null without one.
Json rig_json(const StreamFile& file);

/// The rig of `file`, nothing without one; one that cannot be read is noted and left out.
std::optional<ChosenRig> rig_in(const StreamFile& file);

/// The text of the rig of `file`. Failure (kInput): it has none, or one that cannot be read.
std::string rig_text_of(const StreamFile& file);

}  // namespace hmlfc::cli
