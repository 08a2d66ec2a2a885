// The forms of a light field that hmlfc convert reads and writes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "cli/rig_options.hpp"
#include "cli/view_source.hpp"
#include "io/parallel.hpp"
#include "io/view_list.hpp"
#include "io/y4m.hpp"

namespace hmlfc::cli {

/// What the name of a file or folder does not tell.
enum class Form : uint8_t {
  kTiles,     ///< of a picture
  kLenslets,  ///< of a picture
  kPleno,     ///< of a folder: names as JPEG Pleno's
  kHci,       ///< of a folder: names and parameters.cfg as the HCI benchmark's; written alone
};

/// What pictures of convert say of their origin.
inline constexpr const char* kConvertSign = "hmlfc convert";

struct ConvertOptions {
  std::filesystem::path input;
  std::filesystem::path output;
  bool force = false;
  io::ViewNaming naming;  ///< the order also of a video
  std::optional<Form> from;
  std::optional<Form> to;
  std::optional<uint32_t> row;
  std::optional<int> bits;  ///< of a video that is written
  RigOptions rig;           ///< --no-rig alone
  int threads = 0;
};

/// Whether the name ends as that of a picture.
bool is_picture(const std::filesystem::path& file);

/// Whether the name is that of a video: .y4m, or - for standard output.
bool is_video(const std::filesystem::path& file);

/// Whether the name is that of a stream: .hmlfc.
bool is_stream(const std::filesystem::path& file);

/// A light field in any form, and where its cameras stand, if that is known.
struct ConvertInput {
  std::unique_ptr<ViewSource> views;
  std::optional<ChosenRig> rig;
};

/// The light field of options.input. Failures: options that its form does not have (kUsage), and
/// those of ViewSource::open and rig_for().
ConvertInput open_input(const ConvertOptions& options);

/// All views of `source`. Failures: those of ViewSource::view.
LightField all_views(const ViewSource& source, int threads, const io::Progress& progress);

/// Usage failure where options.output is of no form that is written, or options are not its own.
void check_output(const ConvertOptions& options);

/// Writes `input` to options.output, which check_output accepts. Failures: what does not fit into
/// the form (kUsage), cannot write (kOutput), and those of ViewSource::view.
void write_output(const ConvertOptions& options, const ConvertInput& input,
                  const io::Progress& progress);

}  // namespace hmlfc::cli
