// Whole streams put together by hand, and what every sample of them is by the formulas of
// section 8.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include <hmlfc/decoder.hpp>
#include <hmlfc/error.hpp>

#include "decoder/sample_plane.hpp"
#include "syntax/naive_header.hpp"
#include "syntax/naive_motion.hpp"
#include "syntax/naive_tile.hpp"
#include "syntax/naive_tree.hpp"

namespace hmlfc::test {

/// ROOT, GROUP and TILE of these records (IDX-4 to IDX-6); TOP stays empty. `tiles`: record bytes
/// by tile number, `count`: tiles that the stream could have.
SectionBytes naive_index(const std::map<uint64_t, Bytes>& tiles, uint64_t count);

/// The TOP section of these codestreams and sample CRCs (KEY-1).
Bytes naive_top(const std::vector<std::pair<Bytes, uint32_t>>& codestreams);

/// CRC-32C of samples as KEY-3 says.
uint32_t naive_sample_crc(const SamplePlane& plane);

/// A reference image displaced by (vx, vy) in units of 2^-vector_precision samples of the motion
/// plane.
struct NaiveReference {
  NaiveImage image;
  int64_t vx = 0;
  int64_t vy = 0;
};

/// The motion of one block; without references it has none.
struct NaiveMotion {
  bool negative = false;
  std::vector<NaiveReference> references;
};

/// A stream as its content.
class NaiveStream {
 public:
  /// Random key images and, for about `density` of four tiles, random records.
  NaiveStream(std::mt19937& random, const StreamHeader& header, int density);

  const StreamHeader& header() const { return header_; }
  const NaiveTree& tree() const { return tree_; }

  /// The file's bytes.
  Bytes file() const;

  /// ref(x, y) of DEC-4 and DEC-5 for reference image `from`; x and y may lie outside the plane.
  int64_t reference(const NaiveImage& from, Plane plane, int64_t x, int64_t y) const;

  /// The motion of the block that holds (x, y) (TIL-7, MOT-4 to MOT-8).
  NaiveMotion motion(const NaiveImage& image, Plane plane, uint32_t x, uint32_t y) const;

  /// Blocks by state (TIL-5) over all images but the key images.
  std::array<uint64_t, 4> states() const;

  /// Bits of the parts of the TILE section: vectors and motion tiles, and block residuals.
  uint64_t motion_bits() const;
  uint64_t residual_bits() const;

  /// Puts `bytes` in the place of a tile's record. The values above do not follow.
  void replace_record(const NaiveTile& tile, const Bytes& bytes) { replaced_[tile] = bytes; }

  // The values of DEC-3 at (x, y) in the plane: the parent's sample, ref at the displaced place or
  // R of MOT-9, A, the residual (0 without one) and the result.
  int64_t parent_sample(const NaiveImage& image, Plane plane, uint32_t x, uint32_t y) const;
  int64_t displaced(const NaiveImage& image, Plane plane, uint32_t x, uint32_t y) const;
  int64_t prediction(const NaiveImage& image, Plane plane, uint32_t x, uint32_t y) const;
  int64_t residual(const NaiveImage& image, Plane plane, uint32_t x, uint32_t y) const;
  int64_t sample(const NaiveImage& image, Plane plane, uint32_t x, uint32_t y) const;

 private:
  using PlaneOfImage = std::pair<NaiveImage, Plane>;

  void draw_keys(std::mt19937& random);
  void draw_tiles(std::mt19937& random, int density);
  void draw_motion_tiles(std::mt19937& random, int density);
  NaiveSize motion_tile_size(const NaiveTile& tile) const;
  bool is_halved(Plane plane) const;
  NaiveMotion tile_motion(const NaiveImage& image, Plane plane, uint32_t x, uint32_t y) const;
  EntryModel entry_at(const NaiveTile& tile, uint32_t x, uint32_t y) const;
  int64_t disparity_at(const NaiveImage& image, Plane motion_plane, int64_t gx, int64_t gy) const;
  int64_t interpolated(const NaiveReference& from, Plane plane, int64_t x, int64_t y) const;
  TileContext context_of(const NaiveTile& tile) const;

  /// The block that holds (x, y), or null in an empty tile.
  const BlockModel* block_at(const NaiveImage& image, Plane plane, uint32_t x, uint32_t y) const;
  StreamHeader header_;
  NaiveTree tree_;
  std::map<PlaneOfImage, SamplePlane> keys_;
  std::map<NaiveTile, TileModel> tiles_;
  std::map<NaiveTile, MotionModel> motion_;
  std::map<NaiveTile, DisparityModel> disparities_;
  std::map<NaiveTile, Bytes> replaced_;
};

/// A small random header with several levels and groups.
StreamHeader draw_stream_header(std::mt19937& random);

/// The same of profile extended with `flags`, which fit together (EXT-1).
StreamHeader draw_extended_header(std::mt19937& random, uint32_t flags);

/// Any block of any view.
BlockAddress draw_block(std::mt19937& random, const NaiveStream& stream);

/// Any flags that fit together.
uint32_t draw_flags(std::mt19937& random);

}  // namespace hmlfc::test
