// A stream taken apart into what it is made of, and put together again with less of it.
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

/// One tile of one image, by what it is and not by its number, which depends on the grid.
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

/// A stream of any size that take_apart() accepted.
struct StreamParts {
  StreamHeader header;  ///< its section table has no meaning
  std::map<KeyPlace, KeyCode> keys;
  std::map<TilePlace, std::vector<uint8_t>> tiles;  ///< records that are not empty
};

/// The parts of `stream`; nothing where its index is damaged or it has more than 2^20 tiles.
std::optional<StreamParts> take_apart(const StreamView& stream);

/// The stream of header and parts; parts that the header has no place for are left out. Nothing
/// where the header is not valid, has more than 2^20 tiles, or a key image is missing.
std::optional<std::vector<uint8_t>> put_together(const StreamParts& parts);

/// Gives `parts` the key images that its header asks for and it does not have: the samples that
/// `decoder`, of a stream with these images in its tree, has for them, coded losslessly. False
/// where one does not decode.
bool add_missing_keys(StreamParts& parts, const Decoder& decoder);

/// `samples` of plane `plane` as a codestream of a stream with this header; nothing where memory is
/// out.
std::optional<KeyCode> key_code(const SamplePlane& samples, const StreamHeader& header,
                                unsigned plane);

/// The precision of the key samples of a plane (KEY-2).
SamplePrecision key_precision(const StreamHeader& header, unsigned plane);

}  // namespace hmlfc::conform
