#include "vectors/frame_case.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <ranges>
#include <string_view>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hmlfc::vectors {
namespace {

void set_input(hmlfc_dut_camera& camera, std::string_view name, double value) {
  const auto input = std::ranges::find(kDutCameraInputs, name, &DutCameraInput::name);
  if (input == std::end(kDutCameraInputs)) {
    const auto names = std::views::transform(kDutCameraInputs, &DutCameraInput::name);
    throw TextError(fmt::format("{} is no input of CAM-3: these are {}", io::shown_json(name),
                                fmt::join(names, ", ")));
  }
  camera.*input->value = value;
}

// All or none of the coordinates of each point are given, and integers are integers.
void check_form(const hmlfc_dut_camera& c) {
  const std::tuple<const char*, double, int> integers[] = {
      {"frame_width", c.frame_width, kMaxFrameSide},
      {"frame_height", c.frame_height, kMaxFrameSide},
      {"aperture", c.aperture, kMaxAperture},
      {"filter", c.filter, 2},
      {"geometry", c.geometry, 1}};
  for (const auto& [name, x, greatest] : integers) {
    const int most = greatest < 256 ? 255 : 65536;  // that camera_of() leaves as it is
    if (std::isnan(x) || (x >= 0 && x <= most && x == std::floor(x))) continue;
    throw TextError(fmt::format("{} is {}, no integer up to {}", name, x, greatest));
  }
  const auto check_point = [](double x, double y, double z, const char* names) {
    if (std::isnan(x) == std::isnan(y) && std::isnan(x) == std::isnan(z)) return;
    throw TextError(fmt::format("{} are one point: give all three or none", names));
  };
  check_point(c.pu, c.pv, c.pz, "pu, pv and pz");
  check_point(c.qu, c.qv, c.qz, "qu, qv and qz");
}

}  // namespace

static void visit(const Members& m, FrameSum& frame) {
  m("width", frame.width);
  m("height", frame.height);
  m("depth", frame.depth);
  m.unless_empty("sha256", frame.sha256);
  m("pixels_outside", frame.pixels_outside);
  m("blocks_needed", frame.blocks_needed);
  m("disparities_looked_up", frame.disparities_looked_up);
  if (!m.reading()) return;
  if (frame.width < 1 || frame.width > kMaxFrameSide || frame.height < 1 ||
      frame.height > kMaxFrameSide) {
    throw TextError("a frame has 1 to 4096 pixels a side");
  }
}

static void visit(const Members& m, MapSum& map) {
  m("view_row", map.view.row);
  m("view_col", map.view.col);
  m("columns", map.columns);
  m("rows", map.rows);
  m.unless_empty("sha256", map.sha256);
}

void visit(const Members& m, FrameCase& frame) {
  if (m.reading()) {
    if (m.has("camera")) frame.camera = camera_from(m.json()["camera"]);
  } else if (frame.camera) {
    Json& camera = m.json()["camera"] = Json::object();
    for (const DutCameraInput& input : kDutCameraInputs) {
      const double value = *frame.camera.*input.value;
      if (!std::isnan(value)) camera[input.name] = value;
    }
  }
  m("record", frame.record);
  m.unless_empty("stop_level", frame.stop_level);
  m("frame", frame.frame);
  m("map", frame.map);
  if (!m.reading()) return;
  if (frame.map.has_value() == frame.camera.has_value()) {
    throw TextError("either a camera or a map");
  }
  if (frame.record && frame.record->size() != HMLFC_DUT_RECORD_NUMBERS) {
    throw TextError("a record has 41 numbers");
  }
  if (frame.record.has_value() != frame.frame.has_value()) {
    throw TextError("a record and its frame belong together");
  }
}

bool is_of_stream(const FrameCase& frame, const StreamHeader& header) {
  if (frame.map) {
    const uint32_t side = header.block_size();
    return frame.map->view.row < header.rows && frame.map->view.col < header.cols &&
           frame.map->columns == (header.width + side - 1) / side &&
           frame.map->rows == (header.height + side - 1) / side;
  }
  if (frame.stop_level < 0 || frame.stop_level > header.tree_height) return false;
  if (!frame.record) return true;
  const FrameRecord record = frame_record_of(frame.record->data());
  const auto is = [](int32_t number, uint32_t value) { return int64_t{number} == value; };
  return frame.frame->depth == header.depth && is(record.frame_width, frame.frame->width) &&
         is(record.frame_height, frame.frame->height) && is(record.cols, header.cols) &&
         is(record.rows, header.rows) && is(record.width, header.width) &&
         is(record.height, header.height);
}

hmlfc_dut_camera camera_from(const Json& json) {
  if (!json.is_object()) throw TextError("a camera is an object");
  hmlfc_dut_camera camera = default_dut_camera();
  for (const auto& [name, value] : json.items()) {
    if (!value.is_number()) throw TextError(io::shown_json(name) + " of a camera is no number");
    set_input(camera, name, value.get<double>());
  }
  check_form(camera);
  return camera;
}

std::string camera_words(const hmlfc_dut_camera& camera) {
  std::string words;
  for (const DutCameraInput& input : kDutCameraInputs) {
    const double value = camera.*input.value;
    if (std::isnan(value)) continue;
    words += fmt::format("{}{}={}", words.empty() ? "" : ",", input.name, value);
  }
  return words.empty() ? "focus=0" : words;
}

std::string camera_words(const Camera& camera) {
  hmlfc_dut_camera dut = default_dut_camera();
  const auto set = [](const auto& input, double& target) {
    if (input) target = *input;
  };
  const auto set_point = [](const auto& point, double& u, double& v, double& z) {
    if (point) std::tie(u, v, z) = std::tie(point->u, point->v, point->z);
  };
  const auto set_changed = [](auto input, auto standard, double& target) {
    if (input != standard) target = static_cast<double>(input);
  };
  set(camera.frame_width, dut.frame_width);
  set(camera.frame_height, dut.frame_height);
  set(camera.focal, dut.focal);
  set_changed(camera.shear, 0.0, dut.shear);
  set(camera.row_pitch, dut.row_pitch);
  set_point(camera.position, dut.pu, dut.pv, dut.pz);
  set_point(camera.look_at, dut.qu, dut.qv, dut.qz);
  set(camera.tan_half, dut.tan_half);
  set_changed(camera.focus, 0.0, dut.focus);
  set_changed(camera.aperture, 0, dut.aperture);
  set_changed(camera.filter, Filter::kQuadrilinear, dut.filter);
  set_changed(camera.geometry, GeometrySource::kPlane, dut.geometry);
  return camera_words(dut);
}

hmlfc_dut_camera camera_from_words(std::string_view words) {
  hmlfc_dut_camera camera = default_dut_camera();
  while (!words.empty()) {
    const std::string_view word = words.substr(0, words.find(','));
    words.remove_prefix(std::min(word.size() + 1, words.size()));
    const size_t equals = std::min(word.find('='), word.size());
    const std::string_view number = word.substr(std::min(equals + 1, word.size()));
    double value = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
    set_input(camera, word.substr(0, equals), value);
    if (error != std::errc{} || end != number.data() + number.size() || !std::isfinite(value)) {
      throw TextError(io::shown_json(word) + " is not NAME=NUMBER");
    }
  }
  check_form(camera);
  return camera;
}

std::vector<uint8_t> map_bytes(const std::vector<BlockDisparity>& blocks) {
  std::vector<uint8_t> bytes;
  bytes.reserve(3 * blocks.size());
  for (const BlockDisparity& block : blocks) {
    const auto bits = static_cast<uint16_t>(block.disparity);
    bytes.insert(bytes.end(), {static_cast<uint8_t>(bits & 255), static_cast<uint8_t>(bits >> 8),
                               block.confidence});
  }
  return bytes;
}

}  // namespace hmlfc::vectors
