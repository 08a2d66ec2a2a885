// The golden model's result for a request: the answer and every stage that leads to it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <hmlfc/decoder.hpp>

#include "oracle/golden_stream.hpp"
#include "oracle/level_record.hpp"
#include "oracle/request.hpp"

namespace hmlfc::tb {

/// One block of one plane, from the first level decoded down to the stop level. After a level with
/// an error the sites of the levels below follow, without values.
struct ExpectedPlane {
  uint8_t status = 0;
  std::vector<LevelRecord> levels;
};

/// The answer to one request.
struct ExpectedAnswer {
  Request request;
  Answer answer;
  std::array<std::shared_ptr<const ExpectedPlane>, kPlaneCount> planes;  ///< null: not decoded
  unsigned inside_x =
      0;  ///< columns of the block that lie in the plane; the others have no meaning
  unsigned inside_y = 0;
};

/// Identifies the chroma blocks of a request for RGB: view, stop level and chroma block. The unit
/// omits them where those of the latest request for RGB were the same. Null for other requests and
/// for refused ones.
inline std::optional<uint64_t> chroma_key(const ExpectedAnswer& expected) {
  if (expected.request.plane != kRgb || !expected.planes[1]) return std::nullopt;
  Request chroma = expected.request;
  chroma.bx = expected.planes[1]->levels.back().site.bx;
  chroma.by = expected.planes[1]->levels.back().site.by;
  return chroma.word();
}

/// Whether the stream has what is asked for; a unit refuses other requests.
bool request_exists(const GoldenStream& stream, const Request& request);

/// Evaluates each block once; chroma that several RGB requests share is kept for a while.
class Oracle {
 public:
  /// Answers for a stream that LOAD accepted.
  explicit Oracle(const GoldenStream& stream) : Oracle(stream, &stream.golden_references()) {}

  /// The same with reference blocks from `held`, which must give the same result; null: the golden
  /// path reads each when it is needed.
  Oracle(const GoldenStream& stream, const HeldReferences* held) : stream_(&stream), held_(held) {}

  /// Answers every request with `load_error`, not 0, as a unit whose LOAD ended with it.
  explicit Oracle(uint8_t load_error) : load_error_(load_error) {}

  ExpectedAnswer evaluate(const Request& request);

  const GoldenStream* stream() const { return stream_; }

 private:
  using PlanePointer = std::shared_ptr<const ExpectedPlane>;

  struct CacheLine {
    uint64_t key = ~uint64_t{0};
    PlanePointer plane;
  };

  PlanePointer plane_block(const Request& request, Plane plane, uint32_t bx, uint32_t by);
  PlanePointer decode(const BlockSite& site) const;
  PlanePointer residuals(const BlockSite& site) const;
  void add_motion(LevelRecord& record) const;
  void fill_rgb(ExpectedAnswer& expected) const;

  const GoldenStream* stream_ = nullptr;
  const HeldReferences* held_ = nullptr;
  uint8_t load_error_ = 0;
  std::array<CacheLine, 1024> cache_;
};

/// Columns or rows of block `block` that lie in a plane of `size` samples, in one coordinate.
inline unsigned inside(uint32_t size, uint32_t block, unsigned block_size) {
  return std::min(block_size, size - block * block_size);
}

/// The chroma block that serves block `block` of plane Y, in one coordinate (COL-3).
inline uint32_t chroma_block(uint32_t block, ChromaFormat format) {
  return format == ChromaFormat::k420 ? block >> 1 : block;
}

}  // namespace hmlfc::tb
