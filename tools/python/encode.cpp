#include "python/encode.hpp"

#include <exception>
#include <optional>
#include <string>
#include <utility>

#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <hmlfc/encoder.hpp>

#include "io/light_field_files.hpp"
#include "python/arrays.hpp"

namespace py = pybind11;

namespace hmlfc::python {
namespace {

using MaybeProgress = std::optional<py::function>;

// Calls a Python function of (done, total) from threads without the GIL. The first exception is
// kept until the work is done, and the function is not called again.
class PythonProgress {
 public:
  explicit PythonProgress(const MaybeProgress& function) : function_(function) {}

  void operator()(uint64_t done, uint64_t total) {
    if (!function_ || raised_) return;
    const py::gil_scoped_acquire locked;
    try {
      (*function_)(done, total);
    } catch (...) {
      raised_ = std::current_exception();
    }
  }

  /// With the GIL.
  void rethrow() const {
    if (raised_) std::rethrow_exception(raised_);
  }

 private:
  const MaybeProgress& function_;
  std::exception_ptr raised_;
};

uint32_t side(py::ssize_t size, const char* what, uint32_t most) {
  if (size >= 1 && size <= most) return static_cast<uint32_t>(size);
  throw py::value_error("views have " + std::to_string(size) + " " + what + ", not 1 to " +
                        std::to_string(most));
}

// The depth of views of type T: uint8 has 8 bits, uint16 what is said.
template <class T>
LightField copied(const py::array_t<T, py::array::c_style>& views, int depth) {
  LightFieldShape shape;
  shape.rows = side(views.shape(0), "rows", kMaxGrid);
  shape.cols = side(views.shape(1), "columns", kMaxGrid);
  shape.height = side(views.shape(2), "rows of pixels", kMaxSide);
  shape.width = side(views.shape(3), "columns of pixels", kMaxSide);
  shape.depth = depth;
  const T* from = views.data();
  const py::gil_scoped_release unlocked;
  LightField field(shape);
  std::vector<uint16_t> row(size_t{3} * shape.width);
  const uint32_t most = (1u << depth) - 1;
  for (uint32_t r = 0; r < shape.rows; ++r) {
    for (uint32_t c = 0; c < shape.cols; ++c) {
      for (uint32_t y = 0; y < shape.height; ++y, from += row.size()) {
        for (size_t i = 0; i < row.size(); ++i) {
          if (from[i] > most) {
            throw py::value_error("a sample of view (" + std::to_string(r) + ", " +
                                  std::to_string(c) + ") is " + std::to_string(from[i]) +
                                  ", more than " + std::to_string(depth) + " bits hold");
          }
          row[i] = from[i];
        }
        field.write_row(r, c, y, row);
      }
    }
  }
  return field;
}

LightField field_of(const py::array& views, std::optional<int> depth) {
  if (views.ndim() != 5 || views.shape(4) != 3) {
    throw py::value_error("views are an array of shape (rows, cols, height, width, 3)");
  }
  if (depth && (*depth < 8 || *depth > 12)) throw py::value_error("depth lies in [8, 12]");
  if (py::isinstance<py::array_t<uint8_t>>(views)) {
    if (depth.value_or(8) != 8) throw py::value_error("views of uint8 have depth 8");
    return copied(py::array_t<uint8_t, py::array::c_style>(views), 8);
  }
  if (py::isinstance<py::array_t<uint16_t>>(views)) {
    if (!depth) throw py::value_error("views of uint16 need depth, their bits a sample");
    return copied(py::array_t<uint16_t, py::array::c_style>(views), *depth);
  }
  throw py::type_error("views are an array of uint8 or uint16");
}

template <class T>
T choice(const std::string& value, const char* what,
         std::initializer_list<std::pair<const char*, T>> choices) {
  std::string names;
  for (const auto& [name, meaning] : choices) {
    if (value == name) return meaning;
    names += (names.empty() ? "'" : ", '") + std::string(name) + "'";
  }
  throw py::value_error(std::string(what) + " is one of " + names + ", not '" + value + "'");
}

py::bytes encode_views(const py::array& views, std::optional<int> depth, const std::string& profile,
                       double quality, bool lossless, const std::string& preset,
                       std::optional<double> target_psnr, std::optional<uint64_t> max_bytes,
                       std::optional<int> tree_height, unsigned block_size,
                       const std::optional<std::string>& chroma, int threads,
                       const MaybeProgress& progress) {
  EncodeParams params;
  params.profile = choice<Profile>(profile, "profile",
                                   {{"main", Profile::kMain}, {"extended", Profile::kExtended}});
  if (block_size != 2 && block_size != 4 && block_size != 8) {
    throw py::value_error("block_size is 2, 4 or 8");
  }
  if (tree_height && (*tree_height < 0 || *tree_height > kMaxTreeHeight)) {
    throw py::value_error("tree_height lies in [0, 15]");
  }
  params.lossless = lossless;
  params.tree_height = tree_height;
  params.block_size = block_size;
  params.threads = threads;
  params.extended.quality = quality;
  params.extended.preset = choice<Preset>(
      preset, "preset",
      {{"fast", Preset::kFast}, {"medium", Preset::kMedium}, {"slow", Preset::kSlow}});
  if (chroma) {
    params.chroma = choice<ChromaFormat>(
        *chroma, "chroma", {{"420", ChromaFormat::k420}, {"444", ChromaFormat::k444}});
  }
  if (target_psnr && max_bytes)
    throw py::value_error("target_psnr and max_bytes exclude each other");
  std::optional<EncodeTarget> target;
  if (target_psnr) target = TargetPsnr{*target_psnr};
  if (max_bytes) target = TargetBytes{*max_bytes};
  const LightField field = field_of(views, depth);
  PythonProgress told(progress);
  const auto encoded = [&] {
    const py::gil_scoped_release unlocked;
    const auto tell = [&told](uint64_t done, uint64_t total) { told(done, total); };
    return target ? encode_to(field, params, *target, tell) : encode(field, params, tell);
  }();
  told.rethrow();
  if (!encoded && encoded.error().out_of_memory) throw std::bad_alloc();
  if (!encoded) throw py::value_error(encoded.error().message);
  const auto& bytes = encoded->bytes;
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// The views as an array and their depth.
py::tuple read_views(const std::string& folder, std::optional<std::pair<uint32_t, uint32_t>> grid) {
  io::ViewNaming naming;
  if (grid) naming.grid = io::GridShape{grid->first, grid->second};
  auto field = [&]() -> io::IoResult<LightField> {
    const py::gil_scoped_release unlocked;
    const auto list = io::list_views(folder, naming);
    if (!list) return tl::unexpected(list.error());
    return io::load_light_field(*list, 0);
  }();
  if (!field) {
    PyErr_SetString(field.error().out_of_memory ? PyExc_MemoryError : PyExc_OSError,
                    field.error().message.c_str());
    throw py::error_already_set();
  }
  const LightFieldShape& s = field->shape();
  const std::vector<py::ssize_t> sizes{s.rows, s.cols, s.height, s.width, 3};
  const size_t row = size_t{3} * s.width;
  std::vector<uint16_t> samples(s.depth > 8 ? row * s.height * s.rows * s.cols : row);
  std::vector<uint8_t> bytes(s.depth > 8 ? 0 : row * s.height * s.rows * s.cols);
  size_t at = 0;
  for (uint32_t r = 0; r < s.rows; ++r) {
    for (uint32_t c = 0; c < s.cols; ++c) {
      for (uint32_t y = 0; y < s.height; ++y, at += row) {
        const auto out = std::span(samples).subspan(s.depth > 8 ? at : 0, row);
        field->read_row(r, c, y, out);
        if (s.depth == 8)
          std::copy(out.begin(), out.end(), bytes.begin() + static_cast<ptrdiff_t>(at));
      }
    }
  }
  py::array array =
      s.depth > 8 ? array_of(std::move(samples), sizes) : array_of(std::move(bytes), sizes);
  return py::make_tuple(array, s.depth);
}

}  // namespace

void add_encode(py::module_& module) {
  module.def("encode", &encode_views);
  module.def("read_views", &read_views);
}

}  // namespace hmlfc::python
