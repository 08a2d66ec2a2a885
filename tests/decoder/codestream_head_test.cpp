// What a codestream may declare: OpenJPEG allocates by it, so it is checked before (KEY-2).
#include "decoder/jpeg2000.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>

namespace hmlfc {
namespace {

using Bytes = std::vector<uint8_t>;

// Big-endian.
Bytes number(unsigned count, uint32_t value) {
  Bytes bytes;
  while (count-- > 0) bytes.push_back(static_cast<uint8_t>(value >> (8 * count)));
  return bytes;
}

Bytes join(const std::vector<Bytes>& parts) {
  Bytes bytes;
  for (const Bytes& part : parts) bytes.insert(bytes.end(), part.begin(), part.end());
  return bytes;
}

/// A marker segment: the marker, the length, the content.
Bytes segment(uint32_t marker, const Bytes& content) {
  const auto length = static_cast<uint32_t>(content.size() + 2);
  return join({number(2, marker), number(2, length), content});
}

/// One component of 8 bits, one tile of side x side samples.
Bytes siz(uint32_t side) {
  std::vector<Bytes> fields{number(2, 0)};
  for (const uint32_t field : {side, side, 0u, 0u, side, side, 0u, 0u}) {
    fields.push_back(number(4, field));
  }
  fields.push_back(number(2, 1));
  fields.push_back(number(3, 0x070101));
  return segment(0xFF51, join(fields));
}

/// One layer, one resolution, 64 x 64 code-blocks; transform 1 is the 5/3, 0 the 9/7.
Bytes cod(uint32_t transform = 1) {
  return segment(
      0xFF52, join({number(1, 0), number(4, 0x100), number(4, 0x00040400), number(1, transform)}));
}

/// As above, with precincts of one sample.
Bytes cod_of_small_precincts() {
  return segment(0xFF52, join({number(1, 1), number(4, 0x100), number(4, 0x00040400), number(1, 1),
                               number(1, 0)}));
}

/// The same for component 0 alone.
Bytes coc_of_small_precincts() {
  return segment(0xFF53, join({number(2, 1), number(4, 0x00040400), number(1, 1), number(1, 0)}));
}

Bytes qcd() { return segment(0xFF5C, number(2, 0x4040)); }
Bytes com() { return segment(0xFF64, number(4, 0x00014869)); }

/// Tile-part `index` of `count` with these segments in its header and four bytes of empty packets.
Bytes tile_part(uint32_t index, uint32_t count, const Bytes& segments = {}) {
  const auto length = static_cast<uint32_t>(12 + segments.size() + 2 + 4);
  return join(
      {segment(0xFF90, join({number(2, 0), number(4, length), number(1, index), number(1, count)})),
       segments, number(2, 0xFF93), number(4, 0)});
}

/// SOC, these parts, EOC.
Bytes codestream(std::vector<Bytes> parts) {
  parts.insert(parts.begin(), number(2, 0xFF4F));
  parts.push_back(number(2, 0xFFD9));
  return join(parts);
}

constexpr SamplePrecision kBytes{8, false};

bool has_head(std::span<const uint8_t> bytes, uint32_t side) {
  return has_key_image_head(bytes, side, side, kBytes);
}

void expect_refused(const Bytes& bytes, uint32_t side, const std::string& what) {
  EXPECT_FALSE(has_head(bytes, side)) << what;
}

void expect_decoded(const Bytes& bytes, uint32_t side, const std::string& what) {
  ASSERT_TRUE(has_head(bytes, side)) << what;
  EXPECT_TRUE(decode_jpeg2000(bytes, side, side)) << what;
}

TEST(CodestreamHead, WithoutFault) {
  const Bytes plain = codestream({siz(12), cod(), qcd(), tile_part(0, 1)});
  expect_decoded(plain, 12, "empty packets are a grey picture");
  const Bytes commented = codestream({siz(12), com(), qcd(), com(), cod(), tile_part(0, 1)});
  expect_decoded(commented, 12, "COM, and QCD before COD");
}

/// `bytes` with the `count` bytes at `at` replaced by `value`.
Bytes with_field(Bytes bytes, size_t at, unsigned count, uint32_t value) {
  const Bytes field = number(count, value);
  std::copy(field.begin(), field.end(), bytes.begin() + static_cast<long>(at));
  return bytes;
}

struct Field {
  const char* name;
  size_t at;
  unsigned bytes;
  std::vector<uint32_t> wrong;
  std::vector<uint32_t> right = {};
};

void check_fields(const Bytes& intact, const std::vector<Field>& fields) {
  for (const Field& field : fields) {
    for (const uint32_t value : field.wrong) {
      expect_refused(with_field(intact, field.at, field.bytes, value), 12,
                     field.name + (" = " + std::to_string(value)));
    }
    for (const uint32_t value : field.right) {
      expect_decoded(with_field(intact, field.at, field.bytes, value), 12,
                     field.name + (" = " + std::to_string(value)));
    }
  }
}

// Many tiles or components, or another size: nothing of it gets to OpenJPEG.
TEST(CodestreamHead, OneTileOfOneComponentOfThePlanesSize) {
  check_fields(codestream({siz(12), cod(), qcd(), tile_part(0, 1)}),
               {{"SOC", 0, 2, {0, 0xFF51}},
                {"SIZ", 2, 2, {0, 0xFF52}},
                {"Lsiz", 4, 2, {0, 40, 42, 44}},
                {"Rsiz", 6, 2, {0x4000, 0x8000, 0xFFFF}, {1, 0x3FFF}},
                {"Xsiz", 8, 4, {0, 11, 13, 0x8000000C}},
                {"Ysiz", 12, 4, {0, 11, 13, 0x8000000C}},
                {"XOsiz", 16, 4, {1, 0x80000000}},
                {"YOsiz", 20, 4, {1, 0x80000000}},
                {"XTsiz", 24, 4, {0, 1, 11, 0x80000000}, {13, 0x7FFFFFFF}},
                {"YTsiz", 28, 4, {0, 1, 11, 0x80000000}, {13, 0x7FFFFFFF}},
                {"XTOsiz", 32, 4, {1, 0x80000000}},
                {"YTOsiz", 36, 4, {1, 0x80000000}},
                {"Csiz", 40, 2, {0, 2, 3, 16384, 65535}},
                {"Ssiz", 42, 1, {6, 8, 0x87}},
                {"XRsiz", 43, 1, {0, 2}},
                {"YRsiz", 44, 1, {0, 2}}});
}

TEST(CodestreamHead, EveryFieldOfCodAndQcd) {
  constexpr size_t kCod = 45;
  constexpr size_t kQcd = kCod + 14;
  check_fields(codestream({siz(12), cod(), qcd(), tile_part(0, 1)}),
               {{"Lcod", kCod + 2, 2, {11, 13}},
                {"Scod", kCod + 4, 1, {1, 8, 128}, {2}},
                {"progression", kCod + 5, 1, {5, 255}, {1, 2, 3, 4}},
                {"layers", kCod + 6, 2, {0}, {2}},
                {"component transform", kCod + 8, 1, {1, 2}},
                {"decompositions", kCod + 9, 1, {1, 33}},
                {"code-block width", kCod + 10, 1, {5, 9, 20}, {0, 3}},
                {"code-block height", kCod + 11, 1, {5, 9, 20}, {0, 3}},
                {"code-block style", kCod + 12, 1, {64, 128}, {1, 63}},
                {"transform", kCod + 13, 1, {0, 2}},
                {"Lqcd", kQcd + 2, 2, {3, 5, 7}},
                {"Sqcd", kQcd + 4, 1, {0x41, 0x42, 0x5F}, {0, 0x20, 0xE0}},
                {"SPqcd", kQcd + 5, 1, {0x41, 0x44}, {0, 0xF8}}});
}

/// COD of `levels` decompositions in a progression, with precincts of stated size if there are any,
/// and the QCD that fits.
Bytes cod_and_qcd(uint32_t levels, uint32_t progression, const Bytes& precincts = {}) {
  const Bytes head = join({number(1, precincts.empty() ? 0 : 1), number(1, progression),
                           number(3, 0x100), number(1, levels), number(4, 0x04040001), precincts});
  return join({segment(0xFF52, head), segment(0xFF5C, Bytes(3 * levels + 2, 0x40))});
}

TEST(CodestreamHead, DecompositionsAndPrecincts) {
  const auto with = [](const Bytes& both) { return codestream({siz(12), both, tile_part(0, 1)}); };
  EXPECT_TRUE(has_head(with(cod_and_qcd(32, 1)), 12));
  EXPECT_TRUE(has_head(with(cod_and_qcd(15, 2)), 12));
  expect_refused(with(cod_and_qcd(33, 0)), 12, "33 decompositions");
  for (const uint32_t progression : {2u, 3u, 4u}) {
    expect_refused(with(cod_and_qcd(16, progression)), 12, "16 decompositions");
  }
  expect_decoded(with(cod_and_qcd(2, 0, {255, 255, 255})), 12, "the greatest precincts");
  for (const Bytes& precincts : {Bytes{254, 255, 255}, Bytes{255, 239, 255}, Bytes{255, 255, 15},
                                 Bytes{255, 255}, Bytes{255, 255, 255, 255}}) {
    expect_refused(with(cod_and_qcd(2, 0, precincts)), 12, "precincts");
  }
}

TEST(CodestreamHead, EveryTruncation) {
  const Bytes intact = codestream({siz(12), com(), cod(), qcd(), tile_part(0, 1)});
  for (size_t length = 0; length < intact.size(); ++length) {
    EXPECT_FALSE(has_head(std::span(intact).first(length), 12)) << length;
  }
}

/// A codestream of one tile-part, and where its SOT and EOC are.
struct OneTilePart {
  Bytes bytes = codestream({siz(12), cod(), qcd(), tile_part(0, 1)});
  size_t eoc = bytes.size() - 2;
  size_t sot = eoc - (12 + 2 + 4);

  Bytes with_length(uint32_t length) const { return with_field(bytes, sot + 6, 4, length); }
  Bytes with_count(uint32_t count) const { return with_field(bytes, sot + 11, 1, count); }
};

TEST(CodestreamHead, OneTilePartThatNeedNotTellItsLengthOrNumber) {
  const OneTilePart intact;
  for (const Bytes& bytes : {intact.with_length(0), intact.with_count(0),
                             with_field(intact.with_length(0), intact.sot + 11, 1, 0)}) {
    expect_decoded(bytes, 12, "open length or number");
  }
}

TEST(CodestreamHead, OneTilePartThatEndsAtTheEnd) {
  const OneTilePart intact;
  const auto length = static_cast<uint32_t>(intact.eoc - intact.sot);
  for (const uint32_t wrong : {1u, 12u, 14u, length - 1, length + 1, length + 2, 0xFFFFFFFFu}) {
    expect_refused(intact.with_length(wrong), 12, "Psot = " + std::to_string(wrong));
  }
  for (const uint32_t wrong : {2u, 255u}) {
    expect_refused(intact.with_count(wrong), 12, "TNsot = " + std::to_string(wrong));
  }
  expect_refused(with_field(intact.bytes, intact.sot + 2, 2, 11), 12, "Lsot");
  expect_refused(with_field(intact.bytes, intact.sot + 4, 2, 1), 12, "Isot");
  expect_refused(with_field(intact.bytes, intact.sot + 10, 1, 1), 12, "TPsot");
  expect_refused(with_field(intact.bytes, intact.eoc, 2, 0xFFD8), 12, "EOC");
  for (const Bytes& more : {Bytes{0}, number(2, 0xFFD9), tile_part(1, 0), com()}) {
    expect_refused(join({intact.bytes, more}), 12, "bytes after EOC");
    expect_refused(join({intact.bytes, more, number(2, 0xFFD9)}), 12, "bytes between two EOC");
  }
}

// The 9/7 transform is floating point.
TEST(CodestreamHead, TheReversibleTransformAlone) {
  expect_refused(codestream({siz(12), cod(0), qcd(), tile_part(0, 1)}), 12, "9/7");
  expect_refused(codestream({siz(12), qcd(), tile_part(0, 1)}), 12, "without COD");
  expect_refused(codestream({siz(12), cod(), cod(), qcd(), tile_part(0, 1)}), 12, "two COD");
  expect_refused(codestream({siz(12), cod(), qcd(), qcd(), tile_part(0, 1)}), 12, "two QCD");
  expect_refused(codestream({siz(12), cod(), tile_part(0, 1)}), 12, "no QCD");
  expect_refused(codestream({siz(12), cod(), qcd(), tile_part(0, 1, cod(0))}), 12,
                 "COD of the tile-part");
}

TEST(CodestreamHead, NoOtherSegments) {
  // CAP, COC, RGN, QCC, POC, PPM, TLM, PLM, CRG, and what no marker is.
  for (const uint32_t marker : {0xFF50u, 0xFF53u, 0xFF5Eu, 0xFF5Du, 0xFF5Fu, 0xFF60u, 0xFF55u,
                                0xFF57u, 0xFF63u, 0xFF00u, 0x1234u, 0u}) {
    const Bytes extra = segment(marker, number(4, 0));
    expect_refused(codestream({siz(12), cod(), extra, qcd(), tile_part(0, 1)}), 12,
                   "main header " + std::to_string(marker));
    expect_refused(codestream({siz(12), cod(), qcd(), tile_part(0, 1, extra)}), 12,
                   "tile-part header " + std::to_string(marker));
  }
}

long peak_kilobytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

// One precinct a sample would take hundreds of times the plane's memory, wherever it is asked for.
TEST(CodestreamHead, SmallPrecinctsDoNotTakeMemory) {
  constexpr uint32_t kSide = 1024;
  const long before = peak_kilobytes();
  expect_decoded(codestream({siz(kSide), cod(), qcd(), tile_part(0, 1)}), kSide, "one precinct");
  const Bytes in_place = cod_of_small_precincts();
  expect_refused(codestream({siz(kSide), in_place, qcd(), tile_part(0, 1)}), kSide, "COD");
  for (const Bytes& small : {cod_of_small_precincts(), coc_of_small_precincts()}) {
    expect_refused(codestream({siz(kSide), cod(), small, qcd(), tile_part(0, 1)}), kSide,
                   "main header");
    expect_refused(codestream({siz(kSide), cod(), qcd(), tile_part(0, 1, small)}), kSide,
                   "first tile-part");
    for (const uint32_t count : {0u, 2u}) {
      expect_refused(
          codestream({siz(kSide), cod(), qcd(), tile_part(0, count), tile_part(1, count, small)}),
          kSide, "second tile-part, " + std::to_string(count) + " announced");
    }
  }
  EXPECT_LT(peak_kilobytes() - before, 64 * 1024) << "for 1024 x 1024 samples";
}

}  // namespace
}  // namespace hmlfc
