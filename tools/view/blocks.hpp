// What the page shows inside the stream: planes, blocks, fields.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <tuple>

#include "view/exchange.hpp"
#include "view/open_stream.hpp"
#include "view/plane_trace.hpp"

namespace hmlfc::view {

/// Answers queries with the options view, plane, block and levels of `hmlfc inspect`. All functions
/// may be called at the same time. Failures: those of the query (kUsage), a plane that is too large
/// to be traced (kInput), a corrupt stream (kCorrupt).
class Blocks {
 public:
  /// `stream` must outlive it.
  explicit Blocks(OpenStream& stream) : stream_(stream) {}

  /// The view in RGB, with all planes.
  Response picture(const Query& query) const;

  /// The view of the original, as other_picture() has it.
  Response original(const Query& query, bool difference) const;

  /// A stage of a plane: 16 bits a sample, little-endian; -32768 where the block has none.
  Response stage(const Query& query);

  /// The arrays of PlaneTrace in JSON, and the number of the plane's first tile (IDX-2); for plane
  /// Y with all levels also the disparities of its blocks, and with an original the PSNR of each
  /// block in RGB.
  Response blocks(const Query& query);

  /// The block as `inspect --json` has it ("report"), its fields as `inspect` prints them, with
  /// their raw bits ("levels"), and its error or null.
  Response block(const Query& query) const;

 private:
  using Key = std::tuple<uint32_t, uint32_t, Plane, int>;  // view, plane, stop level
  struct Kept {
    Key key;
    std::shared_ptr<const PlaneTrace> trace;
  };

  std::shared_ptr<const PlaneTrace> trace(const Key& key);

  OpenStream& stream_;
  std::mutex mutex_;
  std::deque<Kept> kept_;  // the planes traced last
};

}  // namespace hmlfc::view
