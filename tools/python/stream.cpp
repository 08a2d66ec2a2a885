#include "python/stream.hpp"

#include <array>
#include <span>
#include <utility>
#include <vector>

#include <hmlfc/disparity.hpp>
#include <hmlfc/rig.hpp>

#include "io/rig_text.hpp"
#include "python/arrays.hpp"
#include "python/block_trace.hpp"

namespace py = pybind11;

namespace hmlfc::python {

Stream::Stream(std::optional<py::buffer_info> buffer, std::unique_ptr<ByteSource> source,
               bool check_sections)
    : buffer_(std::move(buffer)), source_(std::move(source)) {
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
  PyErr_SetString(PyExc_OSError, reason.c_str());
  throw py::error_already_set();
}

std::unique_ptr<Stream> Stream::from_file(const std::string& path, bool check_sections) {
  auto opened = [&] {
    const py::gil_scoped_release unlocked;
    return remote::open_source(path);
  }();
  if (!opened) {
    PyErr_SetString(PyExc_OSError, opened.error().message.c_str());
    throw py::error_already_set();
  }
  const bool check = check_sections && opened->http == nullptr;
  return std::unique_ptr<Stream>(new Stream(std::nullopt, std::move(opened->bytes), check));
}

std::unique_ptr<Stream> Stream::from_buffer(const py::buffer& buffer, bool check_sections) {
  py::buffer_info info = buffer.request();
  if (info.ndim != 1 || info.itemsize != 1 || info.strides.front() != 1) {
    throw py::type_error("a stream in memory is one contiguous sequence of bytes");
  }
  const std::span<const uint8_t> bytes(static_cast<const uint8_t*>(info.ptr),
                                       static_cast<size_t>(info.size));
  return std::unique_ptr<Stream>(
      new Stream(std::move(info), std::make_unique<MemorySource>(bytes), check_sections));
}

py::array Stream::pixels(ViewPos view, const Rect& rect, int stop_level) const {
  std::vector<uint8_t> bytes;
  auto image = [&] {
    const py::gil_scoped_release unlocked;
    auto decoded = decoder_->decode_rgb(view, rect, stop_level);
    if (decoded && decoded->depth == 8) bytes = bytes_of(*decoded);
    return decoded;
  }();
  return array_of(value(std::move(image)), std::move(bytes));
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
  if (!header().has(Feature::kCameraRig)) return py::none();
  const uint64_t views = uint64_t{header().rows} * header().cols;
  const ByteRange range{header().rig.offset, header().rig.size};
  const std::string excess = io::kRigLimits.excess(range.bytes);
  if (!excess.empty()) throw py::value_error("section RIG: " + excess);
  tl::expected<Rig, std::string> read;
  const bool loaded = [&] {
    const py::gil_scoped_release unlocked;
    source_->begin_request();
    const bool is_there = !source_->is_partial() || source_->load({&range, 1});
    if (is_there) read = io::parse_rig(rig_of(source_->bytes(), header()), views);
    source_->end_request();
    return is_there;
  }();
  if (!loaded) raise_failure();
  if (!read) throw py::value_error("section RIG: " + read.error());
  return py::make_tuple(read->metres_per_unit, read->positions, read->rotations, read->intrinsics);
}

py::array Stream::render(const Camera& camera, int stop_level) {
  const auto record = frame_record(camera, header());
  if (!record) throw py::value_error(record.error().message);
  std::vector<uint8_t> bytes;
  RgbImage image;
  auto rendered = [&] {
    const py::gil_scoped_release unlocked;
    const std::lock_guard lock(rendering_);
    if (!renderer_) renderer_ = make_cpu_renderer(*decoder_);
    auto result = renderer_->render(*record, stop_level, frame_);
    if (!result) return result;
    image = frame_.image;
    if (image.depth == 8) bytes = bytes_of(image);
    return result;
  }();
  value(std::move(rendered));
  return array_of(std::move(image), std::move(bytes));
}

namespace {

std::vector<std::string> features_of(const Stream& stream) {
  std::vector<std::string> names;
  for (unsigned bit = 0; bit < kFeatureCount; ++bit) {
    const auto feature = static_cast<Feature>(bit);
    if (stream.header().has(feature)) names.emplace_back(feature_name(feature));
  }
  return names;
}

using Triple = std::array<double, 3>;

std::optional<WorldPoint> point_of(const std::optional<Triple>& point) {
  if (!point) return std::nullopt;
  return WorldPoint{(*point)[0], (*point)[1], (*point)[2]};
}

Filter filter_of(const std::string& name) {
  for (const Filter filter : {Filter::kNearest, Filter::kBilinear, Filter::kQuadrilinear}) {
    if (name == filter_name(filter)) return filter;
  }
  throw py::value_error("filter is 'nearest', 'bilinear' or 'quadrilinear', not '" + name + "'");
}

GeometrySource geometry_of(const std::optional<std::string>& name, const StreamHeader& header) {
  if (!name) return suitable_geometry(header);
  for (const auto geometry : {GeometrySource::kPlane, GeometrySource::kStream}) {
    if (*name == geometry_name(geometry)) return geometry;
  }
  throw py::value_error("geometry is 'stream', 'plane' or None, not '" + *name + "'");
}

py::array render(Stream& stream, const std::optional<Triple>& position,
                 const std::optional<Triple>& look_at, std::optional<uint32_t> width,
                 std::optional<uint32_t> height, std::optional<double> focal,
                 std::optional<double> tan_half, std::optional<double> row_pitch, double shear,
                 double focus, int aperture, const std::string& filter,
                 const std::optional<std::string>& geometry, int stop_level) {
  Camera camera;
  camera.position = point_of(position);
  camera.look_at = point_of(look_at);
  camera.frame_width = width;
  camera.frame_height = height;
  camera.focal = focal;
  camera.tan_half = tan_half;
  camera.row_pitch = row_pitch;
  camera.shear = shear;
  camera.focus = focus;
  camera.aperture = aperture;
  camera.filter = filter_of(filter);
  camera.geometry = geometry_of(geometry, stream.header());
  return stream.render(camera, stop_level);
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
      .def_property_readonly("rows", [](const Stream& s) { return s.header().rows; })
      .def_property_readonly("cols", [](const Stream& s) { return s.header().cols; })
      .def_property_readonly("width", [](const Stream& s) { return s.header().width; })
      .def_property_readonly("height", [](const Stream& s) { return s.header().height; })
      .def_property_readonly("depth", [](const Stream& s) { return s.header().depth; })
      .def_property_readonly("tree_height", [](const Stream& s) { return s.header().tree_height; })
      .def_property_readonly("block_size", [](const Stream& s) { return s.header().block_size(); })
      .def_property_readonly("profile",
                             [](const Stream& s) { return profile_name(s.header().profile); })
      .def_property_readonly("features", &features_of)
      .def("rig", &Stream::rig)
      .def("pixels",
           [](const Stream& s, uint32_t row, uint32_t col, uint32_t x, uint32_t y, uint32_t width,
              uint32_t height, int stop_level) {
             return s.pixels({row, col}, {x, y, width, height}, stop_level);
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
