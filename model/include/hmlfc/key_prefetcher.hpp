// Key images that a moving camera will need, decoded before it is there.
#pragma once

#include <memory>

#include <hmlfc/camera.hpp>
#include <hmlfc/decoder.hpp>
#include <hmlfc/export.hpp>

namespace hmlfc {

/// A thread that decodes the key images that the next frames of a moving camera need, and leaves
/// them in the decoder, so that a renderer of the same decoder does not wait for them. It changes
/// no frame. A corrupt key image is left to the frame that needs it, whose error it is. All
/// functions may be called at the same time.
class HMLFC_EXPORT KeyPrefetcher {
 public:
  static constexpr int kReach = 3;        ///< views from those in use
  static constexpr size_t kMostKeys = 8;  ///< key images of one movement

  /// `decoder` must outlive it.
  explicit KeyPrefetcher(const Decoder& decoder);
  /// Waits for the plane that is being decoded.
  ~KeyPrefetcher();
  KeyPrefetcher(const KeyPrefetcher&) = delete;
  KeyPrefetcher& operator=(const KeyPrefetcher&) = delete;

  /// The frame of `record` has been rendered from views at `stop_level`, both as FrameRenderer
  /// takes them; nothing happens where they do not fit the light field. If the camera has moved
  /// since the last call, key images of the views up to kReach in that direction are wanted, the
  /// nearest first, instead of those wanted before.
  void rendered(const FrameRecord& record, int stop_level);

  /// Waits until nothing is wanted any more.
  void finish();

  /// Whether the calling thread is that of a prefetcher: a ReadSink can tell its reads from those
  /// of frames.
  static bool is_this_thread();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace hmlfc
