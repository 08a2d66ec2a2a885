#include "cli/rig_options.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "cli/arguments.hpp"
#include "io/rig_files.hpp"

namespace hmlfc::cli {
namespace {

io::MaybeRig find_rig(const StreamFile& file) {
  return file.value(io::rig_in_stream(file.source(), file.header()));
}

// "x -1.5 to 3".
std::string extent(const Rig& rig, size_t coordinate) {
  double least = std::numeric_limits<double>::infinity();
  double greatest = -least;
  for (const auto& position : rig.positions) {
    least = std::min(least, position[coordinate]);
    greatest = std::max(greatest, position[coordinate]);
  }
  const char name = "xyz"[coordinate];
  if (least == greatest) return fmt::format("{} {:.6g}", name, least);
  return fmt::format("{} {:.6g} to {:.6g}", name, least, greatest);
}

std::string count_text(size_t entries, const char* none) {
  return entries == 0 ? none : entries == 1 ? "one for all" : "one for each";
}

std::string describe_rig(const Rig& rig) {
  const std::string unit =
      rig.metres_per_unit ? fmt::format(" (unit {} m)", *rig.metres_per_unit) : "";
  return fmt::format("{} cameras at {}, {}, {}{}; rotations: {}; intrinsics: {}",
                     rig.positions.size(), extent(rig, 0), extent(rig, 1), extent(rig, 2), unit,
                     count_text(rig.rotations.size(), "none"),
                     count_text(rig.intrinsics.size(), "not known"));
}

// Cameras of a transforms.json in the folder, or beside it, are taken where the user says so.
void note_transforms(const io::ViewList& views) {
  if (views.files.empty()) return;
  const auto folder = std::filesystem::absolute(views.files.front()).parent_path();
  for (const auto& place : {folder, folder.parent_path()}) {
    const auto file = place / "transforms.json";
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) continue;
    return note(fmt::format("{0} is not used: --rig {0} takes the cameras", file.string()));
  }
}

}  // namespace

void add_rig_options(CLI::App& app, RigOptions& options) {
  const auto reader = [&options](const std::string& text) {
    options.file = text;
    return !text.empty();
  };
  auto* rig =
      add_value(app, "--rig", "FILE.json", "Where the cameras stand; see below", "a path", reader);
  app.add_flag("--no-rig", options.none, "Leave out what folder and file names say of it")
      ->excludes(rig);
}

std::optional<ChosenRig> rig_for(const RigOptions& options, Profile profile,
                                 const io::ViewList& views, const LightFieldShape& shape) {
  if (options.file) {
    if (profile == Profile::kMain) {
      throw Failure(ExitCode::kUsage, "--rig needs --profile extended");
    }
    return ChosenRig{value_or_throw(io::read_rig(*options.file, views, shape), ExitCode::kInput)};
  }
  if (options.none || profile == Profile::kMain) return std::nullopt;
  auto rig = value_or_throw(io::rig_of_views(views, shape), ExitCode::kInput);
  if (!rig) note_transforms(views);
  return rig;
}

std::string rig_line(const StreamFile& file) {
  const auto found = find_rig(file);
  if (!found) return "";
  const std::string text =
      *found ? describe_rig((*found)->rig) : "cannot be read: " + found->error();
  return fmt::format("Rig           {}\n", text);
}

void check_rig(const StreamFile& file) {
  const auto found = find_rig(file);
  if (found && !*found) {
    throw Failure(ExitCode::kCorrupt, file.path().string() + ": " + found->error());
  }
}

std::optional<ChosenRig> rig_in(const StreamFile& file) {
  auto found = find_rig(file);
  if (!found) return std::nullopt;
  if (*found) return ChosenRig{std::move((*found)->rig)};
  note(fmt::format("{}: {}; it is left out", file.path().string(), found->error()));
  return std::nullopt;
}

std::string rig_text_of(const StreamFile& file) {
  check_rig(file);
  auto found = find_rig(file);
  if (!found) {
    throw Failure(ExitCode::kInput,
                  file.path().string() + ": the stream has no rig; encode it with --rig");
  }
  // Outside strings, which have none, a carriage return is space; alone it would be shown escaped.
  std::string text = std::move((*found)->text);
  for (size_t at = text.find('\r'); at != text.npos; at = text.find('\r', at + 1)) {
    if (at + 1 == text.size() || text[at + 1] != '\n') text[at] = '\n';
  }
  return text;
}

}  // namespace hmlfc::cli
