#include "io/light_field_files.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <new>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "io/image_files.hpp"
#include "io/view_name.hpp"

namespace hmlfc::io {

namespace fs = std::filesystem;

namespace {

/// What all views must have in common.
struct ViewShape {
  uint32_t width;
  uint32_t height;
  int depth;

  auto operator<=>(const ViewShape&) const = default;
};

std::string describe(const ViewShape& shape) {
  return fmt::format("{} x {} pixels of {} bits", shape.width, shape.height, shape.depth);
}

ViewShape shape_of(const RgbImage& image) { return {image.width, image.height, image.depth}; }

/// Names the first view whose shape differs from most others, if there is one.
std::optional<IoError> find_odd_view(const ViewList& views, const std::vector<ViewShape>& shapes) {
  std::map<ViewShape, size_t> counts;
  for (const ViewShape& shape : shapes) ++counts[shape];
  if (counts.size() == 1) return std::nullopt;
  const ViewShape usual =
      std::ranges::max_element(counts, {}, &std::pair<const ViewShape, size_t>::second)->first;
  const auto odd = std::ranges::find_if(shapes, [&](const ViewShape& s) { return s != usual; });
  const auto index = static_cast<size_t>(odd - shapes.begin());
  const bool turned =
      odd->width == usual.height && odd->height == usual.width && odd->width != usual.width;
  return IoError{
      fmt::format("{}: the view of row {}, column {} has {}, expected {} like {} other views{}",
                  views.files[index].string(), index / views.cols, index % views.cols,
                  describe(*odd), describe(usual), counts[usual],
                  turned ? "; has it another EXIF orientation than they?" : "")};
}

IoResult<LightField> allocate_field(const ViewList& views, const ViewShape& shape) {
  try {
    return LightField({views.rows, views.cols, shape.width, shape.height, shape.depth});
  } catch (const std::bad_alloc&) {
    return memory_error(views.files.front(), "for " + std::to_string(views.files.size()) +
                                                 " views of " + describe(shape));
  }
}

std::string file_name(FileNames names, uint32_t row, uint32_t col, GridShape grid) {
  switch (names) {
    case FileNames::kPleno:
      return pleno_file_name(row, col);
    case FileNames::kHci:
      return camera_file_name(row * grid.cols + col);
    case FileNames::kRowCol:
      break;
  }
  return view_file_name(row, col, grid.rows, grid.cols);
}

}  // namespace

IoResult<LightField> load_light_field(const ViewList& views, unsigned threads,
                                      const Progress& progress, Notes* notes) {
  std::vector<Notes> notes_of(views.files.size());
  const auto first = read_image(views.files.at(0), {}, notes_of.data());
  if (!first) return tl::unexpected(first.error());
  const ViewShape expected = shape_of(*first);
  auto field = allocate_field(views, expected);
  if (!field) return field;

  std::vector<ViewShape> shapes(views.files.size(), expected);
  FirstError<IoError> first_error;
  const auto load_view = [&](size_t index) {
    if (first_error.makes_pointless(index)) return;
    const auto row = static_cast<uint32_t>(index / views.cols);
    const auto col = static_cast<uint32_t>(index % views.cols);
    if (index == 0) return field->set_view(row, col, *first);
    const auto image = read_image(views.files[index], {}, &notes_of[index]);
    if (!image) return first_error.add(index, image.error());
    shapes[index] = shape_of(*image);
    if (shapes[index] == expected) field->set_view(row, col, *image);
  };
  for_each_index(views.files.size(), threads, progress, load_view);

  for (const Notes& of_view : notes_of) {
    if (notes != nullptr) notes->add(of_view);
  }
  if (first_error.error()) return tl::unexpected(*first_error.error());
  if (const auto odd = find_odd_view(views, shapes)) return tl::unexpected(*odd);
  return field;
}

std::vector<std::string> view_file_names(GridShape grid, FileNames names) {
  std::vector<std::string> files;
  for (uint32_t row = 0; row < grid.rows; ++row) {
    for (uint32_t col = 0; col < grid.cols; ++col)
      files.push_back(file_name(names, row, col, grid));
  }
  return files;
}

IoResult<void> save_views(const fs::path& folder, GridShape grid, const ViewProducer& produce,
                          unsigned threads, const Progress& progress, const SavedAs& as) {
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (failure) return system_error(folder, "cannot create this folder", failure.value());

  FirstError<IoError> first_error;
  const auto save_view = [&](size_t index) {
    if (first_error.makes_pointless(index)) return;
    const auto row = static_cast<uint32_t>(index / grid.cols);
    const auto col = static_cast<uint32_t>(index % grid.cols);
    const fs::path file = folder / file_name(as.names, row, col, grid);
    const auto saved = produce(row, col).and_then([&](const RgbImage& image) {
      return as.names == FileNames::kPleno ? write_ppm(file, image)
                                           : write_png(file, image, as.software);
    });
    if (!saved) first_error.add(index, saved.error());
  };
  for_each_index(size_t{grid.rows} * grid.cols, threads, progress, save_view);
  if (first_error.error()) return tl::unexpected(*first_error.error());
  return {};
}

IoResult<void> save_views(const fs::path& folder, const LightField& field, unsigned threads,
                          const Progress& progress) {
  const GridShape grid{field.shape().rows, field.shape().cols};
  const auto produce = [&](uint32_t row, uint32_t col) -> IoResult<RgbImage> {
    return field.view(row, col);
  };
  return save_views(folder, grid, produce, threads, progress);
}

}  // namespace hmlfc::io
