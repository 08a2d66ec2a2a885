#include "python/stream.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <utility>

#include <hmlfc/disparity.hpp>

#include "io/file_source.hpp"
#include "io/parallel.hpp"
#include "io/stream_report.hpp"
#include "io/stream_rig.hpp"
#include "python/arrays.hpp"
#include "python/block_trace.hpp"
#include "python/interrupt.hpp"
#include "python/options.hpp"

namespace py = pybind11;

namespace hmlfc::python {

Stream::Stream(std::optional<py::buffer_info> buffer, std::unique_ptr<ByteSource> source,
               bool is_remote, bool check_sections)
    : buffer_(std::move(buffer)), source_(std::move(source)), is_remote_(is_remote) {
  OpenOptions options;
  options.check_sections = check_sections;
  auto opened = [&] {
    const py::gil_scoped_release unlocked;
    return Decoder::open(*source_, options);
  }();
  decoder_ = value(std::move(opened));
}

void Stream::raise_failure() const {
  const std::string reason = source_->failure();
  if (reason.empty()) return;
  raise(io::IoError{reason});
}

std::unique_ptr<Stream> Stream::from_file(const std::string& path, bool check_sections) {
  using Source = std::unique_ptr<ByteSource>;
  const bool is_remote = remote::is_address(path);
  auto source = value_or_raise([&]() -> io::IoResult<Source> {
    const py::gil_scoped_release unlocked;
    if (is_remote) return remote::HttpSource::open(path).map([](auto s) -> Source { return s; });
    return io::FileSource::open(path).map([](auto s) -> Source { return s; });
  }());
  return std::unique_ptr<Stream>(
      new Stream(std::nullopt, std::move(source), is_remote, check_sections && !is_remote));
}

std::unique_ptr<Stream> Stream::from_buffer(const py::buffer& buffer, bool check_sections) {
  py::buffer_info info = buffer.request();
  if (info.ndim != 1 || info.itemsize != 1 || info.strides.front() != 1) {
    throw py::type_error("a stream in memory is one contiguous sequence of bytes");
  }
  const std::span<const uint8_t> bytes(static_cast<const uint8_t*>(info.ptr),
                                       static_cast<size_t>(info.size));
  return std::unique_ptr<Stream>(
      new Stream(std::move(info), std::make_unique<MemorySource>(bytes), false, check_sections));
}

namespace {

// Writes the samples of `part`, which is not empty, to `out`. Work that is told to stop leaves some
// out.
template <class T>
Result<void> read_part(const Decoder& decoder, const Part& part, int stop_level, T* out,
                       const std::atomic<bool>& stop) {
  const auto [top, bottom] = std::ranges::minmax(part.ys);
  const auto [left, right] = std::ranges::minmax(part.xs);
  const Rect rect{left, top, right - left + 1, bottom - top + 1};
  io::FirstError<Error> first;
  const auto read_view = [&, top = top, left = left](size_t index) {
    if (stop || first.makes_pointless(index)) return;
    const size_t cols = part.cols.size();
    const auto image =
        decoder.decode_rgb({part.rows[index / cols], part.cols[index % cols]}, rect, stop_level);
    if (!image) return first.add(index, image.error());
    T* to = out + index * part.ys.size() * part.xs.size() * 3;
    for (const uint32_t y : part.ys) {
      const size_t row = size_t{y - top} * rect.width;
      for (const uint32_t x : part.xs) {
        const uint16_t* from = &image->samples[3 * (row + x - left)];
        for (int channel = 0; channel < 3; ++channel) *to++ = static_cast<T>(from[channel]);
      }
    }
  };
  const size_t views = part.rows.size() * part.cols.size();
  if (views == 1) {
    read_view(0);
  } else {
    io::for_each_index(views, 0, {}, read_view);
  }
  if (first.error()) return tl::unexpected(*first.error());
  return {};
}

template <class T>
Result<py::array> array_of_part(const Decoder& decoder, const Part& part, int stop_level) {
  const std::array sizes{part.rows.size(), part.cols.size(), part.ys.size(), part.xs.size(),
                         size_t{3}};
  py::array_t<T> array(std::vector<py::ssize_t>(sizes.begin(), sizes.end()));
  if (array.size() == 0) return array;
  T* out = array.mutable_data();
  const auto read = [&](const std::atomic<bool>& stop) {
    return read_part(decoder, part, stop_level, out, stop);
  };
  const auto done = [&] {
    if (sizes[0] * sizes[1] > 1) return interruptible(read);
    const py::gil_scoped_release unlocked;
    return read(false);
  }();
  if (!done) return tl::unexpected(done.error());
  return array;
}

}  // namespace

py::array Stream::pixels(const Part& part, int stop_level) const {
  return value(header().depth == 8 ? array_of_part<uint8_t>(*decoder_, part, stop_level)
                                   : array_of_part<uint16_t>(*decoder_, part, stop_level));
}

py::object Stream::block(const BlockAddress& block, int stop_level, bool traced) const {
  BlockTrace trace;
  BlockOptions options;
  options.stop_level = stop_level;
  options.trace = traced ? &trace : nullptr;
  auto decoded = [&] {
    const py::gil_scoped_release unlocked;
    return decoder_->decode_block(block, options);
  }();
  if (!decoded && decoded.error().code == ErrorCode::kBadRequest) {
    throw py::index_error("block " + std::to_string(block.bx) + "," + std::to_string(block.by) +
                          " of plane " + std::string(plane_name(block.plane)) + " does not exist");
  }
  const py::ssize_t side = header().block_size();
  py::array samples = array_of(value(std::move(decoded)), {side, side});
  if (!traced) return samples;
  return py::make_tuple(samples, trace.fields(), trace.vectors(), trace.stages(side));
}

py::tuple Stream::disparity(ViewPos view) const {
  std::vector<int16_t> disparities;
  std::vector<uint8_t> confidences;
  auto map = [&] {
    const py::gil_scoped_release unlocked;
    auto found = disparity_map(*decoder_, view);
    if (!found) return found;
    for (const BlockDisparity& block : found->blocks) {
      disparities.push_back(block.disparity);
      confidences.push_back(block.confidence);
    }
    return found;
  }();
  const DisparityMap found = value(std::move(map));
  const auto rows = static_cast<py::ssize_t>(found.blocks.size() / found.columns);
  const py::ssize_t columns = found.columns;
  return py::make_tuple(array_of(std::move(disparities), {rows, columns}),
                        array_of(std::move(confidences), {rows, columns}));
}

py::object Stream::rig() const {
  const io::MaybeRig found = value([&] {
    const py::gil_scoped_release unlocked;
    return io::rig_in_stream(*source_, header());
  }());
  if (!found) return py::none();
  if (!*found) throw py::value_error(found->error());
  return py::str((*found)->text);
}

std::string Stream::info() const {
  return io::json_text(value([&] {
    const py::gil_scoped_release unlocked;
    return io::info_json(*decoder_, *source_);
  }()));
}

py::array Stream::render(const Camera& camera, int stop_level) {
  const auto record = frame_record(camera, header());
  if (!record) {
    const std::string& text = record.error().message;  // frame_width is here width
    throw py::value_error(text.substr(text.starts_with("frame_") ? 6 : 0));
  }
  RgbImage image;
  auto rendered = [&] {
    const py::gil_scoped_release unlocked;
    const std::lock_guard lock(rendering_);
    if (!renderer_) renderer_ = make_cpu_renderer(*decoder_);
    auto result = renderer_->render(*record, stop_level, frame_);
    if (result) image = frame_.image;
    return result;
  }();
  value(std::move(rendered));
  return array_of(image);
}

namespace {

using Places = std::vector<uint32_t>;
using Triple = std::array<double, 3>;

std::optional<WorldPoint> point_of(const Options& given, const char* name) {
  const auto point =
      given.get<std::optional<Triple>>(name, "; it is (x, y, z): column, row and distance");
  if (!point) return std::nullopt;
  return WorldPoint{(*point)[0], (*point)[1], (*point)[2]};
}

py::array render(Stream& stream, const py::kwargs& arguments) {
  const Options given(arguments);
  Camera camera;
  camera.position = point_of(given, "position");
  camera.look_at = point_of(given, "look_at");
  camera.frame_width = given.get<std::optional<uint32_t>>("width");
  camera.frame_height = given.get<std::optional<uint32_t>>("height");
  camera.focal = given.get<std::optional<double>>("focal");
  camera.tan_half = given.get<std::optional<double>>("tan_half");
  camera.row_pitch = given.get<std::optional<double>>("row_pitch");
  camera.shear = given.get<double>("shear");
  camera.focus = given.get<double>("focus");
  if (camera.focus == std::numeric_limits<double>::infinity()) camera.focus = camera.shear;
  camera.aperture = given.get<int>("aperture");
  camera.filter = given.choice<Filter>("filter", {{"nearest", Filter::kNearest},
                                                  {"views", Filter::kViews},
                                                  {"quadrilinear", Filter::kQuadrilinear}});
  camera.geometry = suitable_geometry(stream.header());
  if (given.get<std::optional<std::string>>("geometry")) {
    camera.geometry = given.choice<GeometrySource>(
        "geometry", {{"stream", GeometrySource::kStream}, {"plane", GeometrySource::kPlane}});
  }
  return stream.render(camera, given.get<int>("stop_level"));
}

Plane plane_of(const std::string& name) {
  for (const Plane plane : kPlanes) {
    if (name == plane_name(plane)) return plane;
  }
  throw py::value_error("plane is 'Y', 'Co' or 'Cg', not '" + name + "'");
}

}  // namespace

void add_stream(py::module_& module) {
  py::class_<Stream>(module, "Stream")
      .def_static("from_file", &Stream::from_file)
      .def_static("from_buffer", &Stream::from_buffer)
      .def_property_readonly("shape",
                             [](const Stream& s) {
                               const StreamHeader& h = s.header();
                               return py::make_tuple(h.rows, h.cols, h.height, h.width, 3);
                             })
      .def_property_readonly("depth", [](const Stream& s) { return s.header().depth; })
      .def_property_readonly("tree_height", [](const Stream& s) { return s.header().tree_height; })
      .def_property_readonly("block_size", [](const Stream& s) { return s.header().block_size(); })
      .def_property_readonly("profile",
                             [](const Stream& s) { return profile_name(s.header().profile); })
      .def_property_readonly("features", [](const Stream& s) { return io::tools_of(s.header()); })
      .def_property_readonly("is_remote", &Stream::is_remote)
      .def("rig", &Stream::rig)
      .def("info", &Stream::info)
      .def("pixels",
           [](const Stream& s, Places rows, Places cols, Places ys, Places xs, int stop_level) {
             return s.pixels({std::move(rows), std::move(cols), std::move(ys), std::move(xs)},
                             stop_level);
           })
      .def("block",
           [](const Stream& s, uint32_t row, uint32_t col, const std::string& plane, uint32_t bx,
              uint32_t by, int stop_level, bool traced) {
             return s.block({{row, col}, plane_of(plane), bx, by}, stop_level, traced);
           })
      .def("render", &render)
      .def("disparity", [](const Stream& s, uint32_t row, uint32_t col) {
        return s.disparity({row, col});
      });
}

}  // namespace hmlfc::python
