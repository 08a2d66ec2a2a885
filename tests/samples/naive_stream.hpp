// Whole streams put together by hand, and what every sample of them is by the formulas of
// section 8.
#pragma once

#include <cstdint>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include <hmlfc/error.hpp>

#include "fields/naive_header.hpp"
#include "fields/naive_tile.hpp"
#include "fields/naive_tree.hpp"
#include "samples/sample_plane.hpp"

namespace hmlfc::test {

/// ROOT, GROUP and TILE of these records (IDX-4 to IDX-6); TOP stays empty. `tiles`: record bytes
/// by tile number, `count`: tiles that the stream could have.
SectionBytes naive_index(const std::map<uint64_t, Bytes>& tiles, uint64_t count);

/// The TOP section of these codestreams and sample CRCs (KEY-1).
Bytes naive_top(const std::vector<std::pair<Bytes, uint32_t>>& codestreams);

/// CRC-32C of samples as KEY-3 says.
uint32_t naive_sample_crc(const SamplePlane& plane);

/// A stream as its content.
class NaiveStream {
 public:
  /// Random key images and, for about `density` of four tiles, random records.
  NaiveStream(std::mt19937& random, const StreamHeader& header, int density);

  const StreamHeader& header() const { return header_; }
  const NaiveTree& tree() const { return tree_; }

  /// The file's bytes.
  Bytes file() const;

  /// ref(x, y) of DEC-4 and DEC-5 for image `image`; x and y may lie outside the plane.
  int64_t reference(const NaiveImage& image, Plane plane, int64_t x, int64_t y) const;

  // The values of DEC-3 at (x, y) in the plane: the parent's sample P, ref at the displaced place,
  // A, the residual (0 without one) and the result.
  int64_t parent_sample(const NaiveImage& image, Plane plane, uint32_t x, uint32_t y) const;
  int64_t displaced(const NaiveImage& image, Plane plane, uint32_t x, uint32_t y) const;
  int64_t prediction(const NaiveImage& image, Plane plane, uint32_t x, uint32_t y) const;
  int64_t residual(const NaiveImage& image, Plane plane, uint32_t x, uint32_t y) const;
  int64_t sample(const NaiveImage& image, Plane plane, uint32_t x, uint32_t y) const;

 private:
  using PlaneOfImage = std::pair<NaiveImage, Plane>;

  void draw_keys(std::mt19937& random);
  void draw_tiles(std::mt19937& random, int density);
  TileContext context_of(const NaiveTile& tile) const;

  /// The block that holds (x, y), or null in an empty tile.
  const BlockModel* block_at(const NaiveImage& image, Plane plane, uint32_t x, uint32_t y) const;
  StreamHeader header_;
  NaiveTree tree_;
  std::map<PlaneOfImage, SamplePlane> keys_;
  std::map<NaiveTile, TileModel> tiles_;
};

/// A small random header with several levels and groups.
StreamHeader draw_stream_header(std::mt19937& random);

}  // namespace hmlfc::test
