// What decoding only an area of a key image would save, and which damage it would not notice.
//
// Usage: ./run bench key_areas FILE.hmlfc
// Each plane of each key image of the stream is decoded whole, as the decoder does, and by areas
// with opj_set_decode_area: squares of 64, 128 and 256 samples, one in each corner and one in the
// middle. CPU times are those of one thread, the minimum of many runs for the whole and for the
// mean of the five areas. An area must equal that part of the whole. Then bytes of the codestream
// are changed, one at a time: "damaged" counts those with which the whole does not decode, or to
// other samples, which are errors of every block that reads the plane (KEY-2, KEY-3), "unnoticed"
// those of them with which the area of 64 in the first corner decodes to the samples of the intact
// image.
#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bits/little_endian.hpp"
#include "common/program.hpp"
#include "common/timing.hpp"
#include "decoder/jpeg2000.hpp"
#include "decoder/key_images.hpp"
#include "decoder/open_stream.hpp"
#include "decoder/openjpeg.hpp"
#include "io/mapped_file.hpp"

namespace {

using namespace hmlfc;

constexpr size_t kChanges = 100;

// The samples of `area` of a codestream that `decode_jpeg2000` has taken.
std::optional<SamplePlane> decode_area(std::span<const uint8_t> codestream, const Rect& area) {
  openjpeg::Source source{codestream};
  const openjpeg::Stream stream = openjpeg::open_source(source);
  const openjpeg::Codec codec(opj_create_decompress(OPJ_CODEC_J2K));
  opj_dparameters_t parameters;
  opj_set_default_decoder_parameters(&parameters);
  opj_image_t* raw = nullptr;
  const bool begun = opj_setup_decoder(codec.get(), &parameters) &&
                     opj_decoder_set_strict_mode(codec.get(), OPJ_TRUE) &&
                     opj_read_header(stream.get(), codec.get(), &raw);
  const openjpeg::Image image(raw);
  const auto end = [](uint32_t from, uint32_t length) {
    return static_cast<OPJ_INT32>(from + length);
  };
  if (!begun ||
      !opj_set_decode_area(codec.get(), raw, end(area.x, 0), end(area.y, 0),
                           end(area.x, area.width), end(area.y, area.height)) ||
      !opj_decode(codec.get(), stream.get(), raw) || raw->comps[0].data == nullptr) {
    return std::nullopt;
  }
  SamplePlane plane(area.width, area.height);
  std::transform(raw->comps[0].data, raw->comps[0].data + plane.samples.size(),
                 plane.samples.begin(), [](OPJ_INT32 x) { return static_cast<int16_t>(x); });
  return plane;
}

SamplePlane crop(const SamplePlane& whole, const Rect& area) {
  SamplePlane part(area.width, area.height);
  for (uint32_t y = 0; y < area.height; ++y) {
    std::copy_n(whole.row(area.y + y).begin() + area.x, area.width,
                part.samples.begin() + static_cast<ptrdiff_t>(size_t{y} * area.width));
  }
  return part;
}

// Squares in the corners and in the middle, as far as they fit.
std::array<Rect, 5> areas_of(const SamplePlane& plane, uint32_t side) {
  const uint32_t w = std::min(side, plane.width);
  const uint32_t h = std::min(side, plane.height);
  const uint32_t x = plane.width - w;
  const uint32_t y = plane.height - h;
  return {{{0, 0, w, h}, {x, 0, w, h}, {0, y, w, h}, {x, y, w, h}, {x / 2, y / 2, w, h}}};
}

struct KeyPlane {
  std::span<const uint8_t> codestream;
  SamplePrecision precision;
  SamplePlane whole;
};

std::optional<SamplePlane> decode_whole(const KeyPlane& key, std::span<const uint8_t> codestream) {
  return decode_jpeg2000(codestream, key.whole.width, key.whole.height, key.precision);
}

struct Damage {
  size_t damaged = 0;
  size_t unnoticed = 0;
};

Damage damage(const KeyPlane& key) {
  const Rect corner = areas_of(key.whole, 64)[0];
  const SamplePlane intact = crop(key.whole, corner);
  std::vector<uint8_t> bytes(key.codestream.begin(), key.codestream.end());
  Damage found;
  for (size_t change = 0; change < kChanges; ++change) {
    const size_t at = (2 * change + 1) * bytes.size() / (2 * kChanges);
    bytes[at] ^= 0x10;
    const auto whole = decode_whole(key, bytes);
    if (!whole || whole->samples != key.whole.samples) {
      ++found.damaged;
      const auto part = decode_area(bytes, corner);
      if (part && part->samples == intact.samples) ++found.unnoticed;
    }
    bytes[at] ^= 0x10;
  }
  return found;
}

void report(size_t entry, const KeyPlane& key) {
  const double whole = bench::cpu_seconds_of([&] { (void)decode_whole(key, key.codestream); });
  fmt::print("| {} | {} | {} x {} | {} | {:.1f} |", entry / kPlaneCount,
             std::array{"Y", "Co", "Cg"}[entry % kPlaneCount], key.whole.width, key.whole.height,
             key.codestream.size(), whole * 1e3);
  for (const uint32_t side : {64u, 128u, 256u}) {
    const auto areas = areas_of(key.whole, side);
    for (const Rect& area : areas) {
      const auto part = decode_area(key.codestream, area);
      if (part && part->samples == crop(key.whole, area).samples) continue;
      throw std::runtime_error(
          fmt::format("the area of {} at ({}, {}) differs from the whole", side, area.x, area.y));
    }
    const double five = bench::cpu_seconds_of([&] {
      for (const Rect& area : areas) (void)decode_area(key.codestream, area);
    });
    fmt::print(" {:.1f} |", five / 5 * 1e3);
  }
  const Damage found = damage(key);
  fmt::print(" {} | {} |\n", found.damaged, found.unnoticed);
  std::fflush(stdout);
}

int run(const std::vector<std::string>& arguments) {
  if (arguments.size() != 1) {
    throw std::invalid_argument("usage: ./run bench key_areas FILE.hmlfc");
  }
  const auto file = bench::value_of(io::MappedFile::open(arguments[0]));
  const auto stream = bench::value_of(open_stream(file.bytes(), {}));
  fmt::print(
      "CPU time of one thread in ms; {} changed bytes a plane\n\n"
      "| key image | plane | samples | bytes | whole | 64 | 128 | 256 | damaged | unnoticed |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n",
      kChanges);
  const auto top = stream.bytes(Section::kTop);
  for (size_t entry = 0; entry < stream.geometry.key_count() * kPlaneCount; ++entry) {
    const auto offset = load_le<uint64_t>(top, kTopEntryBytes * entry);
    const auto size = load_le<uint32_t>(top, kTopEntryBytes * entry + 8);
    const Plane plane = kPlanes[entry % kPlaneCount];
    const PlaneShape& shape = stream.geometry.plane(plane);
    const bool chroma = plane != Plane::kY;
    KeyPlane key{top.subspan(static_cast<size_t>(offset), size),
                 {stream.header.depth + (chroma ? 1 : 0), chroma},
                 SamplePlane(shape.width, shape.height)};
    auto whole = decode_whole(key, key.codestream);
    if (!whole) throw std::runtime_error("a key image does not decode");
    key.whole = std::move(*whole);
    report(entry, key);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return bench::run_program("bench_key_areas", [&] { return run({argv + 1, argv + argc}); });
}
