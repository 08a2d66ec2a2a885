// Key images that a moving camera will need, decoded before it is there.
#pragma once

#include <array>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

#include <hmlfc/camera.hpp>
#include <hmlfc/decoder.hpp>

namespace hmlfc::view {

/// A key image in the grid of its level.
struct KeyImage {
  int level = 0;
  uint32_t row = 0;
  uint32_t col = 0;

  friend auto operator<=>(const KeyImage&, const KeyImage&) = default;
};

/// The key images that view `view` is decoded from, down to `stop_level`: its own, those of its
/// reference images and of their ancestors (DEC-1, DEC-4). `header` has passed parse_header.
std::set<KeyImage> key_images_of(const StreamHeader& header, ViewPos view, int stop_level);

/// A thread that decodes key images in the direction of the last movement, with the one for the
/// next views first. The newest movement alone counts. All functions may be called at the same
/// time.
class Ahead {
 public:
  static constexpr int kReach = 3;        ///< views from those in use
  static constexpr size_t kMostKeys = 8;  ///< key images of one movement

  /// `decoder` must outlive it.
  explicit Ahead(const Decoder& decoder);
  /// Waits for the plane that is being decoded.
  ~Ahead();
  Ahead(const Ahead&) = delete;
  Ahead& operator=(const Ahead&) = delete;

  /// A frame has been rendered from `used` (views_in_use) for a camera at column `u` and row `v`.
  void rendered(const std::array<int, 4>& used, double u, double v, int stop_level);

  /// Waits until nothing is left to be decoded.
  void finish();

 private:
  void plan(const std::array<int, 4>& used, double du, double dv, int stop_level);
  void run();

  const Decoder& decoder_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<KeyImage> wanted_;
  std::set<KeyImage> decoded_;
  bool busy_ = false;
  bool ends_ = false;
  bool any_ = false;  // a frame has been rendered, from
  double u_ = 0;
  double v_ = 0;
  std::thread thread_;  // the last: it uses the others
};

}  // namespace hmlfc::view
