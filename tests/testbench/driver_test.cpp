// The C driver against the golden model: what it says of streams, of their tree, of key images.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include <hmlfc/decoder.hpp>

#include "bits/crc32c.hpp"
#include "bits/little_endian.hpp"
#include "decoder/jpeg2000.hpp"
#include "decoder/key_images.hpp"
#include "driver/hmlfc_driver.h"
#include "driver/hmlfc_openjpeg.h"
#include "io/files.hpp"
#include "oracle/golden_stream.hpp"
#include "oracle/reference_area.hpp"
#include "support/streams.hpp"
#include "syntax/header.hpp"
#include "syntax/index.hpp"
#include "vectors/manifest.hpp"
#include "vectors/random.hpp"

namespace hmlfc::tb {
namespace {

using test::Bytes;
using vectors::Random;

constexpr std::array kParts{"HEADER", "TOP", "ROOT", "GROUP", "TILE", "RIG"};
constexpr size_t kAtLevels = 44;

// All streams of the suite, those that must be refused as well.
const std::vector<Bytes>& suite() {
  static const std::vector<Bytes> streams = [] {
    const std::filesystem::path folder = HMLFC_VECTORS;
    std::vector<Bytes> all;
    const auto manifest = vectors::read_manifest(folder);
    for (const auto& vector : manifest->vectors) {
      const auto file = io::map_file(folder / vector.input.file);
      all.emplace_back(file->bytes().begin(), file->bytes().end());
    }
    return all;
  }();
  return streams;
}

std::string text(int code, int section, uint64_t offset) {
  return status_name(static_cast<unsigned>(code)) + " in " + kParts[static_cast<size_t>(section)] +
         " at " + std::to_string(offset);
}

// What the model says of a stream, for a unit of `parameters` or, without them, any decoder.
Error model_error(std::span<const uint8_t> file, const UnitParameters* parameters) {
  const auto header = parse_header(file);
  if (!header) return header.error();
  if (parameters != nullptr && exceeds_limits(*header, *parameters)) {
    return {ErrorCode::kLimitExceeded, Section::kHeader, 0};
  }
  const StreamView view{file, *header, Geometry(*header)};
  if (auto ok = check_index_sizes(view); !ok) return ok.error();
  if (auto ok = check_top_table(view); !ok) return ok.error();
  for (const SectionEntry* entry : section_entries(*header)) {
    if (crc32c(file.subspan(entry->offset, entry->size)) == entry->crc) continue;
    return {ErrorCode::kBadSectionCrc, static_cast<Section>(entry->type), entry->offset};
  }
  return {};
}

// The codes that the two say the same with; each must occur.
using Seen = std::array<unsigned, kErrorCodeCount>;

void expect_same(const Bytes& file, const UnitParameters* parameters, Seen& seen) {
  hmlfc_limits limits{kMaxUnitGrid, kMaxUnitSide, kMaxUnitHeight, 0, 0};
  if (parameters != nullptr) {
    limits.depth = static_cast<uint8_t>(parameters->max_depth);
    limits.block_log2 = static_cast<uint8_t>(parameters->block_log2);
  }
  hmlfc_stream stream;
  hmlfc_error error;
  int code = hmlfc_stream_open(&stream, file.data(), file.size(),
                               parameters != nullptr ? &limits : nullptr, &error);
  if (code == HMLFC_OK) code = hmlfc_stream_check_sections(&stream, &error);
  ASSERT_EQ(code, error.code);
  const Error expected = model_error(file, parameters);
  ASSERT_EQ(
      text(error.code, error.section, error.offset),
      text(static_cast<int>(expected.code), static_cast<int>(expected.section), expected.offset));
  ++seen[static_cast<size_t>(expected.code)];
}

// Any change of a stream, with its checksum right again in most cases.
Bytes damaged(Bytes file, Random& random) {
  if (file.size() < kAtLevels) return file;
  const size_t header = std::min<size_t>(file[10] | file[11] << 8, file.size());
  const unsigned edits = random.within(1, 2);
  for (unsigned i = 0; i < edits; ++i) {
    const size_t at = random.chance(800) ? random.below(std::max<size_t>(header, kAtLevels))
                                         : random.below(file.size());
    const std::array<uint8_t, 5> values{
        static_cast<uint8_t>(file[at] + 1), static_cast<uint8_t>(file[at] - 1),
        static_cast<uint8_t>(random.next()), 0, static_cast<uint8_t>(1u << random.below(8))};
    file[at] = values[random.below(values.size())];
  }
  if (random.chance(950)) test::seal(file);
  if (random.chance(50)) file.resize(random.below(file.size()) + 1);
  if (random.chance(30)) file.push_back(0);
  return file;
}

TEST(Driver, SaysOfEveryVectorWhatTheModelSays) {
  Seen seen{};
  for (const Bytes& file : suite()) {
    ASSERT_NO_FATAL_FAILURE(expect_same(file, nullptr, seen));
    for (const unsigned block_log2 : {1u, 2u, 3u}) {
      const UnitParameters unit{block_log2, 8, 16, 16};
      ASSERT_NO_FATAL_FAILURE(expect_same(file, &unit, seen));
    }
  }
}

TEST(Driver, SaysOfDamagedStreamsWhatTheModelSays) {
  Seen seen{};
  Random random(1);
  const UnitParameters unit{2, 12, 16, 16};
  for (unsigned i = 0; i < 40'000; ++i) {
    const Bytes file = damaged(suite()[random.below(suite().size())], random);
    ASSERT_NO_FATAL_FAILURE(expect_same(file, random.chance(500) ? nullptr : &unit, seen)) << i;
  }
  for (size_t code = 0; code <= HMLFC_BAD_TOP_ENTRY; ++code) {
    EXPECT_GE(seen[code], 5u) << status_name(static_cast<unsigned>(code));
  }
  EXPECT_GE(seen[HMLFC_LIMIT_EXCEEDED], 5u);
}

// Every field of FIL-1 and EXT-2 at and next to the ends of its interval and of the unit's limits.
TEST(Driver, SaysOfEveryFieldsEndsWhatTheModelSays) {
  struct Field {
    size_t at;
    unsigned bytes;
  };
  std::vector<Field> fields{{16, 2}, {18, 2}, {20, 4}, {24, 4}};
  for (size_t at = 28; at < kAtLevels + 8; ++at) fields.push_back({at, 1});
  Seen seen{};
  const UnitParameters unit{2, 10, 16, 16};
  for (size_t i = 0; i < suite().size(); i += 16) {
    if (!parse_header(suite()[i])) continue;
    for (const Field& field : fields) {
      for (const uint64_t edge :
           {1u, 2u, 4u, 6u, 8u, 11u, 16u, 128u, 255u, 1024u, 4096u, 16384u, 65536u}) {
        for (const uint64_t value : {edge - 1, edge, edge + 1}) {
          if (value >> 8 * field.bytes != 0) continue;
          Bytes file = suite()[i];
          test::patch(file, field.at, field.bytes, value);
          test::seal(file);
          ASSERT_NO_FATAL_FAILURE(expect_same(file, nullptr, seen));
          ASSERT_NO_FATAL_FAILURE(expect_same(file, &unit, seen));
        }
      }
    }
  }
  EXPECT_GE(seen[HMLFC_BAD_HEADER_FIELD], 1000u);
  EXPECT_GE(seen[HMLFC_LIMIT_EXCEEDED], 100u);
}

void expect_same_tree(const hmlfc_stream& stream, const Geometry& geometry) {
  ASSERT_EQ(stream.images, geometry.image_count());
  ASSERT_EQ(stream.tiles_per_image, geometry.tiles_per_image());
  ASSERT_EQ(stream.key_images, geometry.key_count());
  for (const AreaPlane& plane : area_layout(geometry).planes) {
    const auto level = static_cast<unsigned>(plane.level);
    const ImagePos group = geometry.group_of(plane.level, plane.image);
    uint32_t row = 0;
    uint32_t col = 0;
    hmlfc_reference_image(&stream, level, group.row, group.col, &row, &col);
    ASSERT_EQ((ImagePos{row, col}), plane.image);
    ASSERT_EQ(
        hmlfc_area_offset(&stream, level, group.row, group.col, static_cast<unsigned>(plane.plane)),
        plane.offset);
  }
}

// The strips of key images in an area; all others are 0.
Bytes keyed_part(const ReferenceArea& area, const Geometry& geometry) {
  Bytes bytes = area.bytes;
  for (const AreaPlane& plane : area.layout.planes) {
    if (geometry.level(plane.level).keyed) continue;
    std::fill_n(bytes.begin() + static_cast<ptrdiff_t>(plane.offset), plane.size, uint8_t{0});
  }
  return bytes;
}

// Planes of key images that do not decode, in the order of the area; the first of them.
std::pair<uint64_t, Error> failed_planes(const GoldenStream& stream) {
  std::pair<uint64_t, Error> failed;
  for (const AreaPlane& plane : area_layout(stream.geometry()).planes) {
    if (!stream.geometry().level(plane.level).keyed) continue;
    const auto decoded = stream.keys().plane(plane.level, plane.image, plane.plane);
    if (!decoded && failed.first++ == 0) failed.second = decoded.error();
  }
  return failed;
}

TEST(Driver, FillsTheAreaWithTheModelsKeyImages) {
  unsigned areas = 0;
  std::array<unsigned, kErrorCodeCount> failures{};
  for (const Bytes& file : suite()) {
    const auto header = parse_header(file);
    if (!header) continue;
    const UnitParameters unit{header->block_log2, 12, 16, 16};
    const auto golden = GoldenStream::open(file, unit);
    if (!golden) continue;
    hmlfc_stream stream;
    hmlfc_error error;
    ASSERT_EQ(hmlfc_stream_open(&stream, file.data(), file.size(), nullptr, &error), HMLFC_OK);
    ASSERT_NO_FATAL_FAILURE(expect_same_tree(stream, (*golden)->geometry()));
    const ReferenceArea expected =
        build_reference_area((*golden)->view(), (*golden)->keys(), (*golden)->fast_references());
    ASSERT_EQ(stream.area_bytes, expected.bytes.size());
    Bytes area(expected.bytes.size());
    std::vector<int16_t> samples(size_t{stream.width} * stream.height);
    const auto [failed, first] = failed_planes(**golden);
    const hmlfc_buffer buffer{area.data(), 0, area.size()};
    uint64_t planes = 0;
    ASSERT_EQ(hmlfc_fill_key_images(&stream, &buffer, hmlfc_openjpeg_decode, nullptr,
                                    samples.data(), samples.size(), &planes, &error),
              HMLFC_OK);
    ASSERT_EQ(planes, failed);
    ASSERT_EQ(text(error.code, error.section, error.offset),
              text(static_cast<int>(first.code), static_cast<int>(first.section), first.offset));
    ++failures[static_cast<size_t>(first.code)];
    ASSERT_EQ(area, keyed_part(expected, (*golden)->geometry()));
    ++areas;
  }
  EXPECT_GE(areas, 500u);
  for (const int code : {HMLFC_BAD_TOP_IMAGE, HMLFC_BAD_TOP_CRC, HMLFC_TOP_SAMPLE_RANGE}) {
    EXPECT_GE(failures[static_cast<size_t>(code)], 1u) << code;
  }
}

TEST(Driver, TakesTheHeadsOfCodestreamsThatTheModelTakes) {
  Random random(2);
  std::array<unsigned, 2> seen{};
  for (const Bytes& file : suite()) {
    const auto header = parse_header(file);
    if (!header || header->sections[0].size < 48) continue;
    const auto top = std::span(file).subspan(header->sections[0].offset, header->sections[0].size);
    for (unsigned i = 0; i < 60; ++i) {
      const int chroma = i % 3 != 0 ? 1 : 0;
      const uint64_t begin = load_le<uint64_t>(top, i % 3 * 16);
      const uint64_t count = load_le<uint32_t>(top, i % 3 * 16 + 8);
      if (begin > top.size() || count > top.size() - begin) continue;
      const auto codestream = top.subspan(begin, count);
      Bytes head(codestream.begin(), codestream.end());
      if (i >= 3 && !head.empty()) {
        const size_t at = random.below(std::min<size_t>(head.size(), 130));
        head[at] = static_cast<uint8_t>(random.chance(300) ? random.next() : head[at] ^ 1);
        if (random.chance(100)) head.resize(random.below(head.size()) + 1);
      }
      const PlaneShape p = Geometry(*header).plane(kPlanes[i % 3]);
      const int bits = header->depth + chroma;
      const bool model = has_key_image_head(head, p.width, p.height, {bits, chroma != 0});
      ASSERT_EQ(model ? 1 : 0, hmlfc_has_key_image_head(head.data(), head.size(), p.width, p.height,
                                                        static_cast<unsigned>(bits), chroma));
      ++seen[model ? 1 : 0];
    }
  }
  EXPECT_GE(std::ranges::min(seen), 1000u);
}

// Strips of every width, and those of blocks that could not be decoded.
TEST(Driver, PacksStripsAsTheModelPacksThem) {
  Random random(3);
  for (unsigned i = 0; i < 2000; ++i) {
    const unsigned block_log2 = random.within(1, 3);
    const uint32_t b = 1u << block_log2;
    const hmlfc_plane plane{b * (64 / (b * b)), b, 64 / (b * b), 1, 1, HMLFC_STRIP_BYTES};
    const unsigned bits = random.within(0, 14);
    const int base = static_cast<int>(random.below((1u << 14) - (1u << bits) + 1)) - (1 << 13);
    const int error = random.chance(100) ? static_cast<int>(random.within(1, 31)) : 0;
    std::vector<int16_t> samples(64);
    StripSamples strip{};
    for (uint32_t k = 0; k < 64; ++k) {
      const auto value = base + static_cast<int>(random.below(uint64_t{1} << bits));
      strip[k] = error != 0 ? poison_of(static_cast<ErrorCode>(error)) : value;
      const uint32_t x = k / (b * b) * b + k % b;
      samples[k % (b * b) / b * plane.width + x] = static_cast<int16_t>(value);
    }
    Bytes place(HMLFC_STRIP_BYTES);
    hmlfc_pack_plane(&plane, block_log2, samples.data(), error, place.data());
    const auto expected = pack_strip(strip);
    ASSERT_TRUE(std::ranges::equal(place, expected)) << i;
  }
}

}  // namespace
}  // namespace hmlfc::tb
