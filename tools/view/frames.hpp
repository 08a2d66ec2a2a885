// Frames of novel views for the page.
#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include <hmlfc/key_prefetcher.hpp>
#include <hmlfc/renderer.hpp>

#include "view/exchange.hpp"
#include "view/open_stream.hpp"

namespace hmlfc::view {

/// Renders what queries with the options of `hmlfc render` ask for, one frame at a time. All
/// functions may be called at the same time. Failures: those of the query, cameras that take no
/// frame (kUsage), a corrupt stream (kCorrupt).
class Frames {
 public:
  /// `stream` must outlive it. With `ahead` the next key images are decoded ahead of the motion.
  Frames(OpenStream& stream, bool ahead) : stream_(stream), looks_ahead_(ahead) {}

  /// The frame's pixels; the header Frame says what it cost, in JSON: width, height, seconds,
  /// needed, decoded, reused (blocks), touched (bytes of the file), key_samples (of key images that
  /// it had to wait for), views (first and last row and column), outside (the share of pixels that
  /// see nothing of the light field).
  Response frame(const Query& query);

  /// The PNG file that `hmlfc render` writes.
  Response png(const Query& query);

  /// The focus for what the pixel focus-at shows: {"focus": 1.25}.
  Response focus(const Query& query) const;

  /// How the pixel "trace" comes about: what `hmlfc render --trace --json` prints, and under
  /// "inputs" the text for --inputs that gives the same frame.
  Response trace(const Query& query) const;

  /// Waits until nothing is decoded ahead any more.
  void finish_ahead();

 private:
  // The last frame and its record, while `mutex_` is held.
  FrameRecord render(const Query& query);

  OpenStream& stream_;
  std::mutex mutex_;
  std::unique_ptr<FrameRenderer> renderer_;  // made for the first frame
  Frame frame_;
  bool looks_ahead_;
  std::optional<KeyPrefetcher> prefetcher_;  // made for the first frame
};

}  // namespace hmlfc::view
