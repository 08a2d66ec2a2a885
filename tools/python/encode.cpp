#include "python/encode.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <hmlfc/encoder.hpp>

#include "io/light_field_files.hpp"
#include "io/stream_rig.hpp"
#include "io/view_name.hpp"
#include "python/arrays.hpp"
#include "python/interrupt.hpp"
#include "python/options.hpp"
#include "python/raise.hpp"

namespace hmlfc::python {
namespace {

// A light field to encode, and the names of its views.
struct Field {
  static constexpr const char* kName = "hmlfc.Field";
  LightField views;
  io::ViewList files;
  io::Notes notes;
};

Object folder_field(const Options& given) {
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
      throw Raised(PyExc_ValueError,
                   "order is raster, serpentine, columns or columns-serpentine, not " + *order);
    }
    naming.order = found->second;
  }
  auto field = std::make_unique<Field>();
  value_or_raise(interruptible([&](const auto& stop) -> io::IoResult<void> {
    auto files = io::list_views(folder, naming);
    if (!files) return tl::unexpected(files.error());
    const auto tell = [&](size_t, size_t) {
      if (stop) throw Stopped();
    };
    auto views = io::load_light_field(*files, 0, tell, &field->notes);
    if (!views) return tl::unexpected(views.error());
    field->files = std::move(*files);
    field->views = std::move(*views);
    return {};
  }));
  return hold(std::move(field));
}

uint32_t side(Py_ssize_t size, const char* what, uint32_t most) {
  if (size >= 1 && size <= most) return static_cast<uint32_t>(size);
  throw Raised(PyExc_ValueError, "views have " + std::to_string(size) + " " + what + ", not 1 to " +
                                     std::to_string(most));
}

// Fills `views` from samples that lie as in an array of Python.
template <class T>
void fill(LightField& views, const void* samples) {
  const LightFieldShape& shape = views.shape();
  const T* from = static_cast<const T*>(samples);
  std::vector<uint16_t> row(size_t{3} * shape.width);
  for (uint32_t r = 0; r < shape.rows; ++r) {
    for (uint32_t c = 0; c < shape.cols; ++c) {
      for (uint32_t y = 0; y < shape.height; ++y, from += row.size()) {
        std::copy_n(from, row.size(), row.begin());
        views.write_row(r, c, y, row);
      }
    }
  }
}

// Of an array of five dimensions in C's order, whose samples have at most `depth` bits.
Object array_field(const Options& given) {
  const Buffer pixels(given.object("pixels"), PyBUF_ND);
  const Py_buffer& view = pixels.view();
  auto field = std::make_unique<Field>();
  io::ViewList& files = field->files;
  files.rows = side(view.shape[0], "rows", kMaxGrid);
  files.cols = side(view.shape[1], "columns", kMaxGrid);
  const uint32_t height = side(view.shape[2], "rows of pixels", kMaxSide);
  const uint32_t width = side(view.shape[3], "columns of pixels", kMaxSide);
  const int depth = given.get<int>("depth");
  {
    const Unlocked unlocked;
    field->views = LightField({files.rows, files.cols, width, height, depth});
    for (uint32_t i = 0; i < files.rows * files.cols; ++i) {
      files.files.emplace_back(
          io::view_file_name(i / files.cols, i % files.cols, files.rows, files.cols));
    }
    if (view.itemsize == 1) {
      fill<uint8_t>(field->views, view.buf);
    } else {
      fill<uint16_t>(field->views, view.buf);
    }
  }
  return hold(std::move(field));
}

template <class T>
Object pixels_as(const LightField& views) {
  const LightFieldShape& shape = views.shape();
  Array<T> pixels({shape.rows, shape.cols, shape.height, shape.width, 3});
  T* to = pixels.data();
  std::vector<uint16_t> samples(size_t{3} * shape.width);
  for (uint32_t r = 0; r < shape.rows; ++r) {
    for (uint32_t c = 0; c < shape.cols; ++c) {
      for (uint32_t y = 0; y < shape.height; ++y) {
        views.read_row(r, c, y, samples);
        for (const uint16_t sample : samples) *to++ = static_cast<T>(sample);
      }
    }
  }
  return pixels.object();
}

EncodeParams params_of(const Options& given) {
  EncodeParams params;
  params.profile = given.choice<Profile>(
      "profile", {{"main", Profile::kMain}, {"extended", Profile::kExtended}});
  params.extended.quality = given.get<double>("quality", -64, kHighestQuality).value();
  params.main.threshold_ref = threshold_of_quality(params.extended.quality);
  params.main.threshold_pred = params.main.threshold_ref;
  params.main.rate_distortion = given.get<bool>("rate_distortion");
  params.lossless = given.get<bool>("lossless");
  params.extended.preset = given.choice<Preset>(
      "preset", {{"fast", Preset::kFast}, {"medium", Preset::kMedium}, {"slow", Preset::kSlow}});
  params.tree_height = given.get<int>("tree_height", 0, kMaxTreeHeight);
  params.block_size = given.get<unsigned>("block_size");
  if (params.block_size != 2 && params.block_size != 4 && params.block_size != 8) {
    throw Raised(PyExc_ValueError, "block_size is 2, 4 or 8");
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
    if (!rig) throw Raised(PyExc_ValueError, "rig: " + rig.error());
    return io::ChosenRig{std::move(*rig)};
  }
  if (!given.get<bool>("rig_of_views")) return std::nullopt;
  return value_or_raise(io::rig_of_views(field.files, shape));
}

// The stream, its PSNR over RGB, and the most bytes that were asked for or None.
Object encode_field(const Options& given) {
  const Field& field = given.held<Field>("field");
  const EncodeParams params = params_of(given);
  const auto rig = rig_of(field, given);
  const LightFieldShape& shape = field.views.shape();
  const auto most = most_bytes(given, shape);
  std::optional<EncodeTarget> target;
  if (const auto least = given.get<double>("target_psnr", 1, 100)) target = TargetPsnr{*least};
  if (most) target = TargetBytes{*most - std::min(*most - 1, rig ? most_rig_bytes(*rig) : 0)};
  const auto progress = given.get<std::optional<Function>>("progress");
  auto encoded = interruptible([&](const auto& stop) {
    const auto tell = [&](uint64_t done, uint64_t total) {
      if (stop) throw Stopped();
      if (!progress) return;
      const Locked locked;
      Object(PyObject_CallObject(progress->object.get(), tuple_of(done, total).get()));
    };
    auto stream =
        target ? encode_to(field.views, params, *target, tell) : encode(field.views, params, tell);
    if (stream && rig) stream->bytes = stream_with_rig(stream->bytes, *rig);
    return stream;
  });
  if (!encoded && encoded.error().out_of_memory) throw std::bad_alloc();
  if (!encoded) throw Raised(PyExc_ValueError, encoded.error().message);
  const uint64_t samples = uint64_t{3} * shape.rows * shape.cols * shape.width * shape.height;
  const auto& bytes = encoded->bytes;
  const Object stream(
      PyBytes_FromStringAndSize(reinterpret_cast<const char*>(bytes.data()), std::ssize(bytes)));
  return tuple_of(stream, psnr(encoded->error.rgb_squares, samples, shape.depth), most);
}

Object field_facts(const Options& given) {
  const Field& field = given.held<Field>("field");
  std::vector<Object> notes;
  for (const std::string& line : field.files.notes) notes.push_back(message_of(line));
  for (const std::string& line : field.notes.lines()) notes.push_back(message_of(line));
  return tuple_of(field.views.shape().depth, notes);
}

Object field_pixels(const Options& given) {
  const LightField& views = given.held<Field>("field").views;
  return views.shape().depth == 8 ? pixels_as<uint8_t>(views) : pixels_as<uint16_t>(views);
}

}  // namespace

void add_encode(std::vector<PyMethodDef>& methods) {
  methods.push_back(method<&folder_field>("folder_field"));
  methods.push_back(method<&array_field>("array_field"));
  methods.push_back(method<&field_facts>("field_facts"));
  methods.push_back(method<&field_pixels>("field_pixels"));
  methods.push_back(method<&encode_field>("encode"));
}

}  // namespace hmlfc::python
