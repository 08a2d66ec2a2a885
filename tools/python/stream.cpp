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

namespace hmlfc::python {

Stream::Stream(std::optional<Buffer> buffer, std::unique_ptr<ByteSource> source, bool is_remote,
               bool check_sections)
    : buffer_(std::move(buffer)), source_(std::move(source)), is_remote_(is_remote) {
  OpenOptions options;
  options.check_sections = check_sections;
  auto opened = [&] {
    const Unlocked unlocked;
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
    const Unlocked unlocked;
    if (is_remote) return remote::HttpSource::open(path).map([](auto s) -> Source { return s; });
    return io::FileSource::open(path).map([](auto s) -> Source { return s; });
  }());
  return std::unique_ptr<Stream>(
      new Stream(std::nullopt, std::move(source), is_remote, check_sections && !is_remote));
}

std::unique_ptr<Stream> Stream::from_buffer(PyObject* object, bool check_sections) {
  Buffer buffer(object, PyBUF_SIMPLE);
  const Py_buffer& view = buffer.view();
  const std::span<const uint8_t> bytes(static_cast<const uint8_t*>(view.buf),
                                       static_cast<size_t>(view.len));
  return std::unique_ptr<Stream>(
      new Stream(std::move(buffer), std::make_unique<MemorySource>(bytes), false, check_sections));
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
Result<Object> array_of_part(const Decoder& decoder, const Part& part, int stop_level) {
  const size_t views = part.rows.size() * part.cols.size();
  Array<T> array({part.rows.size(), part.cols.size(), part.ys.size(), part.xs.size(), 3});
  if (array.size() == 0) return array.object();
  T* out = array.data();
  const auto read = [&](const std::atomic<bool>& stop) {
    return read_part(decoder, part, stop_level, out, stop);
  };
  const auto done = [&] {
    if (views > 1) return interruptible(read);
    const Unlocked unlocked;
    return read(false);
  }();
  if (!done) return tl::unexpected(done.error());
  return array.object();
}

}  // namespace

Object Stream::pixels(const Part& part, int stop_level) const {
  return value(header().depth == 8 ? array_of_part<uint8_t>(*decoder_, part, stop_level)
                                   : array_of_part<uint16_t>(*decoder_, part, stop_level));
}

Object Stream::block(const BlockAddress& block, int stop_level, bool traced) const {
  BlockTrace trace;
  BlockOptions options;
  options.stop_level = stop_level;
  options.trace = traced ? &trace : nullptr;
  auto decoded = [&] {
    const Unlocked unlocked;
    return decoder_->decode_block(block, options);
  }();
  if (!decoded && decoded.error().code == ErrorCode::kBadRequest) {
    throw Raised(PyExc_IndexError, "block " + std::to_string(block.bx) + "," +
                                       std::to_string(block.by) + " of plane " +
                                       std::string(plane_name(block.plane)) + " does not exist");
  }
  const size_t side = header().block_size();
  const Object samples = array_of<int32_t>(value(std::move(decoded)), {side, side});
  if (!traced) return samples;
  return tuple_of(samples, trace.fields(), trace.vectors(), trace.stages(side));
}

Object Stream::disparity(ViewPos view) const {
  std::vector<int16_t> disparities;
  std::vector<uint8_t> confidences;
  auto map = [&] {
    const Unlocked unlocked;
    auto found = disparity_map(*decoder_, view);
    if (!found) return found;
    for (const BlockDisparity& block : found->blocks) {
      disparities.push_back(block.disparity);
      confidences.push_back(block.confidence);
    }
    return found;
  }();
  const DisparityMap found = value(std::move(map));
  const std::vector<size_t> shape{found.blocks.size() / found.columns, found.columns};
  return tuple_of(array_of<int16_t>(disparities, shape), array_of<uint8_t>(confidences, shape));
}

Object Stream::rig() const {
  const io::MaybeRig found = value([&] {
    const Unlocked unlocked;
    return io::rig_in_stream(*source_, header());
  }());
  if (!found) return object_of(std::optional<int>());
  if (!*found) throw Raised(PyExc_ValueError, found->error());
  return object_of((*found)->text);
}

std::string Stream::info() const {
  return io::json_text(value([&] {
    const Unlocked unlocked;
    return io::info_json(*decoder_, *source_);
  }()));
}

Object Stream::render(const Camera& camera, int stop_level) {
  const auto record = frame_record(camera, header());
  if (!record) {
    const std::string& text = record.error().message;  // frame_width is here width
    throw Raised(PyExc_ValueError, text.substr(text.starts_with("frame_") ? 6 : 0));
  }
  RgbImage image;
  auto rendered = [&] {
    const Unlocked unlocked;
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

using Triple = std::array<double, 3>;

std::optional<WorldPoint> point_of(const Options& given, const char* name) {
  const auto point =
      given.get<std::optional<Triple>>(name, "; it is (x, y, z): column, row and distance");
  if (!point) return std::nullopt;
  return WorldPoint{(*point)[0], (*point)[1], (*point)[2]};
}

Object render(const Options& given) {
  auto& stream = given.held<Stream>("stream");
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
  throw Raised(PyExc_ValueError, "plane is 'Y', 'Co' or 'Cg', not '" + name + "'");
}

Object open_file(const Options& given) {
  return hold(Stream::from_file(given.get<std::string>("path"), given.get<bool>("check_sections")));
}

Object open_buffer(const Options& given) {
  return hold(Stream::from_buffer(given.object("buffer"), given.get<bool>("check_sections")));
}

Object facts(const Options& given) {
  const auto& stream = given.held<Stream>("stream");
  const StreamHeader& header = stream.header();
  Object dict(PyDict_New());
  put(dict, "shape", tuple_of(header.rows, header.cols, header.height, header.width, 3));
  put(dict, "depth", header.depth);
  put(dict, "tree_height", header.tree_height);
  put(dict, "block_size", header.block_size());
  put(dict, "profile", profile_name(header.profile));
  put(dict, "features", io::tools_of(header));
  put(dict, "is_remote", stream.is_remote());
  return dict;
}

Object rig(const Options& given) { return given.held<Stream>("stream").rig(); }

Object info(const Options& given) { return object_of(given.held<Stream>("stream").info()); }

Object pixels(const Options& given) {
  const auto places = [&](const char* name) { return given.get<std::vector<uint32_t>>(name); };
  return given.held<Stream>("stream").pixels(
      {places("rows"), places("cols"), places("ys"), places("xs")}, given.get<int>("stop_level"));
}

ViewPos view_of(const Options& given) {
  return {given.get<uint32_t>("row"), given.get<uint32_t>("col")};
}

Object block(const Options& given) {
  const BlockAddress address{view_of(given), plane_of(given.get<std::string>("plane")),
                             given.get<uint32_t>("bx"), given.get<uint32_t>("by")};
  return given.held<Stream>("stream").block(address, given.get<int>("stop_level"),
                                            given.get<bool>("traced"));
}

Object disparity(const Options& given) {
  return given.held<Stream>("stream").disparity(view_of(given));
}

}  // namespace

void add_stream(std::vector<PyMethodDef>& methods) {
  methods.push_back(method<&open_file>("open_file"));
  methods.push_back(method<&open_buffer>("open_buffer"));
  methods.push_back(method<&facts>("facts"));
  methods.push_back(method<&rig>("rig"));
  methods.push_back(method<&info>("info"));
  methods.push_back(method<&pixels>("pixels"));
  methods.push_back(method<&block>("block"));
  methods.push_back(method<&render>("render"));
  methods.push_back(method<&disparity>("disparity"));
}

}  // namespace hmlfc::python
