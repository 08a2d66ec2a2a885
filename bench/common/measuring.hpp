// What the subcommands of hmlfc_measure share: errors, camera paths, reads of a file.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include <fmt/format.h>
#include <tl/expected.hpp>

#include <hmlfc/camera.hpp>
#include <hmlfc/decoder.hpp>

#include "io/files.hpp"

namespace hmlfc::bench {

/// The value of `made`, or std::runtime_error with the message of its error.
template <class Value, class Failure>
Value value_of(tl::expected<Value, Failure> made) {
  if (!made) {
    if constexpr (requires { made.error().message; }) {
      throw std::runtime_error(made.error().message);
    } else {
      throw std::runtime_error(to_string(made.error()));
    }
  }
  if constexpr (!std::is_void_v<Value>) return std::move(*made);
}

/// body() as main of the program `name`. Exit status: 0, 2 std::invalid_argument, 1 any other
/// exception; both print their message.
template <class Body>
int run_program(const std::string& name, const Body& body) {
  try {
    body();
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", name, error.what());
    return dynamic_cast<const std::invalid_argument*>(&error) != nullptr ? 2 : 1;
  }
}

/// Camera `frame` of `frames` on an ellipse around the middle of the grid, its half axes 3/8 of the
/// grid, looking straight ahead; square frames of `side` pixels. frames >= 1, side in
/// [1, kMaxFrameSide].
inline Camera orbit_camera(const StreamHeader& header, int frame, int frames, uint32_t side) {
  const double angle = 2 * std::numbers::pi * frame / frames;
  Camera camera;
  camera.frame_width = side;
  camera.frame_height = side;
  camera.position = WorldPoint{(header.cols - 1) * (0.5 + 0.375 * std::cos(angle)),
                               (header.rows - 1) * (0.5 + 0.375 * std::sin(angle)), 0};
  return camera;
}

/// The distinct reads of a file by one thread, and the samples of the key planes that it decoded.
class Reads final : public ReadSink {
 public:
  void on_read(uint64_t offset, uint64_t bytes) override {
    if (bytes > 0) ranges_.insert({offset, bytes});
  }
  void on_key_plane(uint64_t samples) override { key_samples_ += samples; }

  /// [offset, length] each.
  const std::set<std::array<uint64_t, 2>>& ranges() const { return ranges_; }
  uint64_t key_samples() const { return key_samples_; }
  void forget_ranges() { ranges_.clear(); }

 private:
  std::set<std::array<uint64_t, 2>> ranges_;
  uint64_t key_samples_ = 0;
};

/// A stream whose sections are not checked, so that opening it reads its header alone.
inline Decoder open_unchecked(std::span<const uint8_t> file, Reads* reads = nullptr) {
  OpenOptions options;
  options.check_sections = false;
  options.reads = reads;
  return value_of(Decoder::open(file, options));
}

}  // namespace hmlfc::bench
