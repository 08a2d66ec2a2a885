#include "python/encode.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>

#include <hmlfc/encoder.hpp>

#include "io/light_field_files.hpp"
#include "io/stream_rig.hpp"
#include "io/view_name.hpp"
#include "python/interrupt.hpp"
#include "python/options.hpp"
#include "python/raise.hpp"

namespace py = pybind11;

namespace hmlfc::python {
namespace {

// A light field to encode, and the names of its views.
struct Field {
  LightField views;
  io::ViewList files;
  io::Notes notes;
};

Field read_folder(const py::kwargs& arguments) {
  const Options given(arguments);
  const auto folder = given.get<std::string>("folder");
  io::ViewNaming naming;
  if (const auto grid = given.pair("grid", kMaxGrid)) {
    naming.grid = io::GridShape{grid->first, grid->second};
  }
  naming.pattern = given.get<std::optional<std::string>>("names").value_or("");
  if (auto order = given.get<std::optional<std::string>>("order")) {
    if (*order == "rows") order = "raster";
    const auto* found = std::ranges::find(io::kFrameOrders, *order,
                                          &std::pair<std::string_view, io::FrameOrder>::first);
    if (found == io::kFrameOrders.end()) {
      throw py::value_error("order is raster, serpentine, columns or columns-serpentine, not " +
                            *order);
    }
    naming.order = found->second;
  }
  return value_or_raise(interruptible([&](const auto& stop) -> io::IoResult<Field> {
    Field field;
    auto files = io::list_views(folder, naming);
    if (!files) return tl::unexpected(files.error());
    const auto tell = [&](size_t, size_t) {
      if (stop) throw Stopped();
    };
    auto views = io::load_light_field(*files, 0, tell, &field.notes);
    if (!views) return tl::unexpected(views.error());
    field.files = std::move(*files);
    field.views = std::move(*views);
    return field;
  }));
}

uint32_t side(py::ssize_t size, const char* what, uint32_t most) {
  if (size >= 1 && size <= most) return static_cast<uint32_t>(size);
  throw py::value_error("views have " + std::to_string(size) + " " + what + ", not 1 to " +
                        std::to_string(most));
}

// Views whose samples have at most `depth` bits.
template <class T>
Field read_array(const py::array_t<T, py::array::c_style>& views, int depth) {
  Field field;
  io::ViewList& files = field.files;
  files.rows = side(views.shape(0), "rows", kMaxGrid);
  files.cols = side(views.shape(1), "columns", kMaxGrid);
  const uint32_t height = side(views.shape(2), "rows of pixels", kMaxSide);
  const uint32_t width = side(views.shape(3), "columns of pixels", kMaxSide);
  const T* from = views.data();
  const py::gil_scoped_release unlocked;
  field.views = LightField({files.rows, files.cols, width, height, depth});
  std::vector<uint16_t> samples(size_t{3} * width);
  for (uint32_t r = 0; r < files.rows; ++r) {
    for (uint32_t c = 0; c < files.cols; ++c) {
      files.files.emplace_back(io::view_file_name(r, c, files.rows, files.cols));
      for (uint32_t y = 0; y < height; ++y, from += samples.size()) {
        std::copy_n(from, samples.size(), samples.begin());
        field.views.write_row(r, c, y, samples);
      }
    }
  }
  return field;
}

template <class T>
py::array pixels_as(const LightField& views) {
  const LightFieldShape& shape = views.shape();
  py::array_t<T> pixels(
      std::vector<py::ssize_t>{shape.rows, shape.cols, shape.height, shape.width, 3});
  T* to = pixels.mutable_data();
  std::vector<uint16_t> samples(size_t{3} * shape.width);
  for (uint32_t r = 0; r < shape.rows; ++r) {
    for (uint32_t c = 0; c < shape.cols; ++c) {
      for (uint32_t y = 0; y < shape.height; ++y) {
        views.read_row(r, c, y, samples);
        for (const uint16_t sample : samples) *to++ = static_cast<T>(sample);
      }
    }
  }
  return pixels;
}

EncodeParams params_of(const Options& given) {
  EncodeParams params;
  params.profile = given.choice<Profile>(
      "profile", {{"main", Profile::kMain}, {"extended", Profile::kExtended}});
  params.extended.quality = given.get<double>("quality", 0, 100).value();
  // Of profile main, as `hmlfc encode --quality` has it.
  const double threshold = 75 * std::exp2((60 - params.extended.quality) / 10);
  params.main.threshold_ref = static_cast<uint32_t>(std::lround(threshold));
  params.main.threshold_pred = params.main.threshold_ref;
  params.lossless = given.get<bool>("lossless");
  params.extended.preset = given.choice<Preset>(
      "preset", {{"fast", Preset::kFast}, {"medium", Preset::kMedium}, {"slow", Preset::kSlow}});
  params.tree_height = given.get<int>("tree_height", 0, kMaxTreeHeight);
  params.block_size = given.get<unsigned>("block_size");
  if (params.block_size != 2 && params.block_size != 4 && params.block_size != 8) {
    throw py::value_error("block_size is 2, 4 or 8");
  }
  params.window = given.get<int>("window", 0, kMaxWindow);
  if (const auto references = given.pair("references", 255)) {
    std::tie(params.ref_rows, params.ref_cols) = *references;
  }
  if (given.get<std::optional<std::string>>("chroma")) {
    params.chroma = given.choice<ChromaFormat>(
        "chroma", {{"420", ChromaFormat::k420}, {"444", ChromaFormat::k444}});
  }
  params.threads = given.get<int>("threads", 0, 1024).value_or(0);
  return params;
}

// The most bytes of the stream.
std::optional<uint64_t> most_bytes(const Options& given, const LightFieldShape& shape) {
  const auto bits = given.get<double>("target_bpp", 0, 1000);
  if (!bits) return given.get<uint64_t>("max_bytes", 1, int64_t{1} << 62);
  const double pixels = static_cast<double>(shape.rows) * shape.cols * shape.width * shape.height;
  return std::max<uint64_t>(1, static_cast<uint64_t>(std::floor(*bits * pixels / 8)));
}

// The one of a file, of a text, or what files and names of the views tell.
std::optional<io::ChosenRig> rig_of(const Field& field, const Options& given) {
  const LightFieldShape& shape = field.views.shape();
  if (const auto file = given.get<std::optional<std::string>>("rig_file")) {
    return io::ChosenRig{value_or_raise(io::read_rig(*file, field.files, shape))};
  }
  if (const auto text = given.get<std::optional<std::string>>("rig_text")) {
    auto rig = io::parse_rig(io::bytes_of(*text), field.files.files.size());
    if (!rig) throw py::value_error("rig: " + rig.error());
    return io::ChosenRig{std::move(*rig)};
  }
  if (!given.get<bool>("rig_of_views")) return std::nullopt;
  return value_or_raise(io::rig_of_views(field.files, shape));
}

// The stream, its PSNR over RGB, and the most bytes that were asked for or None.
py::tuple encode_field(const Field& field, const py::kwargs& arguments) {
  const Options given(arguments);
  const EncodeParams params = params_of(given);
  const auto rig = rig_of(field, given);
  const LightFieldShape& shape = field.views.shape();
  const auto most = most_bytes(given, shape);
  std::optional<EncodeTarget> target;
  if (const auto least = given.get<double>("target_psnr", 1, 100)) target = TargetPsnr{*least};
  if (most) target = TargetBytes{*most - std::min(*most - 1, rig ? most_rig_bytes(*rig) : 0)};
  const auto progress = given.get<std::optional<py::function>>("progress");
  auto encoded = interruptible([&](const auto& stop) {
    const auto tell = [&](uint64_t done, uint64_t total) {
      if (stop) throw Stopped();
      if (!progress) return;
      const py::gil_scoped_acquire locked;
      (*progress)(done, total);
    };
    auto stream =
        target ? encode_to(field.views, params, *target, tell) : encode(field.views, params, tell);
    if (stream && rig) stream->bytes = stream_with_rig(stream->bytes, *rig);
    return stream;
  });
  if (!encoded && encoded.error().out_of_memory) throw std::bad_alloc();
  if (!encoded) throw py::value_error(encoded.error().message);
  const uint64_t samples = uint64_t{3} * shape.rows * shape.cols * shape.width * shape.height;
  const auto& bytes = encoded->bytes;
  return py::make_tuple(py::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size()),
                        psnr(encoded->error.rgb_squares, samples, shape.depth), most);
}

py::list notes_of(const Field& field) {
  py::list notes;
  for (const std::string& line : field.files.notes) notes.append(message_of(line));
  for (const std::string& line : field.notes.lines()) notes.append(message_of(line));
  return notes;
}

}  // namespace

void add_encode(py::module_& module) {
  py::class_<Field>(module, "Field")
      .def_static("from_folder", &read_folder)
      .def_static("from_array", &read_array<uint8_t>)
      .def_static("from_array", &read_array<uint16_t>)
      .def_property_readonly("depth", [](const Field& f) { return f.views.shape().depth; })
      .def_property_readonly("notes", &notes_of)
      .def("pixels",
           [](const Field& f) {
             const LightField& views = f.views;
             return views.shape().depth == 8 ? pixels_as<uint8_t>(views)
                                             : pixels_as<uint16_t>(views);
           })
      .def("encode", &encode_field);
}

}  // namespace hmlfc::python
