// Bit strings, checksums, masks.
#include <bit>

#include "arithmetic/rounding.hpp"
#include "bits/bit_string.hpp"
#include "bits/crc32c.hpp"
#include "bits/little_endian.hpp"
#include "primitives/primitive.hpp"
#include "syntax/tile_masks.hpp"

namespace hmlfc::primitives {
namespace {

size_t bytes_of_bits(uint32_t bits) { return ceil_div(bits, 8u); }

std::string read_field(const Inputs& in) {
  const uint32_t bits = in["bits"];
  const uint32_t field = BitString(in.bytes).field(in["position"], bits);
  return joined(field, sign_extend(field, bits));
}

std::string count_bits(const Inputs& in) {
  const auto mask = load_le<uint64_t>(in.bytes, 0);
  return joined(std::popcount(mask), rank(mask, in["i"]));
}

std::string read_tile_mask(const Inputs& in) {
  PlaneShape plane;
  plane.blocks_x = in["columns"];
  plane.blocks_y = in["rows"];
  FieldCursor cursor(BitString(in.bytes), 0, {});
  const uint64_t mask = read_mask(cursor, in["mode"], blocks_inside(plane, 0, 0));
  return joined(mask, cursor.position());
}

// Modes 0 and 1 take no bits, 2 takes 64, 3 at most 16 + 64 (TIL-3).
size_t bytes_of_mask(const Inputs& in) {
  constexpr size_t kBytes[] = {0, 0, 8, 10};
  return kBytes[static_cast<size_t>(in["mode"])];
}

}  // namespace

std::vector<Primitive> bit_primitives() {
  return {
      {"field",
       "CNV-4 CNV-5",
       {within("bits", 0, 31), within("position", 0, 64)},
       random_bytes("a bit string that holds the field",
                    [](const Inputs& in) {
                      return bytes_of_bits(uint32_t{in["position"]} + uint32_t{in["bits"]});
                    }),
       "unsigned signed",
       kDrawn,
       read_field},
      {"rank",
       "CNV-6",
       {within("i", 0, 63)},
       random_bytes("8, the mask, little-endian", [](const Inputs&) { return size_t{8}; }),
       "popcount rank",
       kDrawn,
       count_bits},
      {"crc",
       "FIL-5",
       {within("count", 0, 300)},
       random_bytes("count", [](const Inputs& in) { return size_t{in["count"]}; }),
       "crc",
       kDrawn,
       [](const Inputs& in) { return joined(crc32c(in.bytes)); }},
      {"block-number",
       "TIL-2",
       {within("i", 0, 7), within("j", 0, 7)},
       {},
       "k",
       kAll,
       [](const Inputs& in) { return joined(block_number(in["i"], in["j"])); }},
      {"mask",
       "TIL-3",
       {within("mode", 0, 3), within("columns", 1, 8, "columns of the tile's blocks in the plane"),
        within("rows", 1, 8, "their rows")},
       random_bytes("none in modes 0 and 1, 8 in mode 2, 10 in mode 3: they begin with the mask",
                    bytes_of_mask),
       "mask bits_taken",
       kDrawn,
       read_tile_mask},
  };
}

}  // namespace hmlfc::primitives
