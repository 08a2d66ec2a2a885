// Splits a stream into its parts, and builds a stream of fewer parts.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include <hmlfc/decoder.hpp>

#include "decoder/jpeg2000.hpp"
#include "decoder/sample_plane.hpp"
#include "syntax/stream_view.hpp"

namespace hmlfc::conform {

/// One tile of one image, by its place, since its number depends on the grid.
struct TilePlace {
  int level = 0;
  uint32_t row = 0;  ///< of the image
  uint32_t col = 0;
  unsigned slot = 0;  ///< planes 0 to 2, then motion planes from 3 on
  uint32_t ty = 0;
  uint32_t tx = 0;

  friend auto operator<=>(const TilePlace&, const TilePlace&) = default;
};

/// One plane of one key image.
struct KeyPlace {
  int level = 0;
  uint32_t row = 0;
  uint32_t col = 0;
  unsigned plane = 0;

  friend auto operator<=>(const KeyPlace&, const KeyPlace&) = default;
};

struct KeyCode {
  std::vector<uint8_t> codestream;
  uint32_t sample_crc = 0;
};

/// The parts of a stream.
struct StreamParts {
  StreamHeader header;  ///< its section table has no meaning
  std::map<KeyPlace, KeyCode> keys;
  std::map<TilePlace, std::vector<uint8_t>> tiles;  ///< records that are not empty
  std::vector<uint8_t> rig;                         ///< section RIG
};

/// The parts of `stream`; nothing if its index is damaged or it has more than 2^20 tiles.
std::optional<StreamParts> take_apart(const StreamView& stream);

/// The stream of `parts`, without those that its header has no place for. Nothing if the header is
/// not valid, has more than 2^20 tiles, or a key image is missing.
std::optional<std::vector<uint8_t>> put_together(const StreamParts& parts);

/// Adds the key images that the header asks for and `parts` lacks: the samples that `decoder`, of a
/// stream with these images in its tree, gives for them, coded losslessly. False if one does not
/// decode.
bool add_missing_keys(StreamParts& parts, const Decoder& decoder);

/// `samples` of plane `plane` as a codestream of a stream with this header; nothing if memory runs
/// out.
std::optional<KeyCode> key_code(const SamplePlane& samples, const StreamHeader& header,
                                unsigned plane);

/// The precision of the key samples of a plane (KEY-2).
SamplePrecision key_precision(const StreamHeader& header, unsigned plane);

}  // namespace hmlfc::conform
