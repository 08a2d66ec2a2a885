#include "io/rig_files.hpp"

#include <set>
#include <utility>
#include <vector>

#include "io/files.hpp"
#include "io/hci_parameters.hpp"
#include "io/rig_text.hpp"
#include "io/transforms.hpp"
#include "io/view_name.hpp"

namespace hmlfc::io {
namespace {

// `rig`, if a stream may hold it.
IoResult<Rig> checked(const std::filesystem::path& file, const Rig& rig, const ViewList& views) {
  auto read = parse_rig(bytes_of(rig_text(rig)), views.files.size());
  if (!read) return file_error(file, read.error());
  return std::move(*read);
}

// Leaves those entries of a whole grid that are of `views`; one for all stays.
template <class Entry>
void choose(const ViewList& views, std::vector<Entry>& entries) {
  if (entries.size() <= 1) return;
  const auto all = std::exchange(entries, {});
  for (const size_t number : views.numbers) entries.push_back(all[number]);
}

// The sum over all views of coordinate * (row or column less the middle one): above 0 where the
// coordinate grows along them.
double trend(const Rig& rig, uint32_t cols, size_t coordinate, bool along_rows) {
  double sum = 0;
  const auto last = rig.positions.size() - 1;
  for (size_t i = 0; i <= last; ++i) {
    const size_t at = along_rows ? i / cols : i % cols;
    const size_t end = along_rows ? last / cols : cols - 1;
    const double from_middle = static_cast<double>(at) - static_cast<double>(end) / 2;
    sum += from_middle * rig.positions[i][coordinate];
  }
  return sum;
}

}  // namespace

IoResult<Rig> read_rig(const std::filesystem::path& file, const ViewList& views,
                       const LightFieldShape& shape) {
  if (lower_case_extension(file) == ".cfg") {
    const auto parameters = read_hci_parameters(file);
    if (!parameters) return tl::unexpected(parameters.error());
    const auto rig = rig_of_hci(*parameters, views, shape);
    if (!rig) return file_error(file, rig.error());
    return checked(file, *rig, views);
  }
  const auto mapped = map_file(file);
  if (!mapped) return tl::unexpected(mapped.error());
  const auto json = parse_json<nlohmann::json>(mapped->bytes(), kTransformsLimits);
  if (!json) return file_error(file, json.error());
  if (!json->is_object() || !json->contains("frames")) {
    const auto positions = json->find("positions");
    const size_t entries = positions == json->end() ? 0 : positions->size();
    const bool of_grid = entries > 0 && entries == views.whole;
    auto rig = parse_rig(mapped->bytes(), of_grid ? entries : views.files.size());
    if (!rig) return file_error(file, rig.error());
    if (of_grid) {
      choose(views, rig->positions);
      choose(views, rig->rotations);
      choose(views, rig->intrinsics);
    }
    return std::move(*rig);
  }
  CameraPictures pictures{{}, shape.width, shape.height};
  for (const auto& view : views.files) pictures.stems.push_back(view.stem().string());
  if (std::set(pictures.stems.begin(), pictures.stems.end()).size() < views.files.size()) {
    for (size_t i = 0; i < views.files.size(); ++i) {
      pictures.stems[i] = (views.files[i].parent_path().filename() / pictures.stems[i]).string();
    }
  }
  const auto rig = rig_of_transforms(*json, pictures);
  if (!rig) return file_error(file, rig.error());
  return checked(file, *rig, views);
}

IoResult<std::optional<Rig>> rig_beside(const ViewList& views, const LightFieldShape& shape) {
  // Views in folders of rows may have it next to these.
  for (const auto& folder : {views.files.front().parent_path(), views.folder}) {
    for (const std::string_view name : {kRigName, kHciParametersName}) {
      const auto file = file_named(folder, name);
      if (file.empty()) continue;
      auto rig = read_rig(file, views, shape);
      if (!rig) return tl::unexpected(IoError{rig.error().message + " (--no-rig leaves it out)"});
      return std::move(*rig);
    }
  }
  return std::nullopt;
}

IoResult<std::optional<Rig>> rig_of_names(const ViewList& views) {
  Rig rig;
  for (const auto& file : views.files) {
    const auto place = parse_camera_place(file.stem().string());
    if (!place) return std::nullopt;
    rig.positions.push_back({place->x, place->y, 0});
  }
  const double x = trend(rig, views.cols, 0, false) < 0 ? -1 : 1;
  const double y = trend(rig, views.cols, 1, true) < 0 ? -1 : 1;
  for (auto& position : rig.positions) position = {x * position[0], y * position[1], 0};
  auto good = checked(views.files.front().parent_path(), rig, views);
  if (!good) return tl::unexpected(good.error());
  return std::move(*good);
}

}  // namespace hmlfc::io
