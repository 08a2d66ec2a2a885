// Key images: coefficients with missing bit-planes, and whole planes.
#include <new>

#include "arithmetic/rounding.hpp"
#include "decoder/jpeg2000.hpp"
#include "primitives/planes.hpp"

namespace hmlfc::primitives {
namespace {

// EXT-6. The golden model leaves this to OpenJPEG, which key-plane runs.
std::string reconstruct_coefficient(const Inputs& in) {
  const int64_t m = in["m"];
  const int b = in["b"];
  const uint32_t minus = in["minus"];
  const int64_t magnitude = m == 0 ? 0 : (m << b) + (int64_t{1} << b) / 2;
  return joined(minus != 0 ? -magnitude : magnitude);
}

SamplePrecision precision_of(const Inputs& in) {
  const bool chroma = plane_of(in) != Plane::kY;
  return {int{in["depth"]} + (chroma ? 1 : 0), chroma};
}

// A plane of noise around a slope, which reaches both ends of the interval; coded with all its
// passes or without some of them.
std::vector<uint8_t> draw_codestream(const Inputs& in, vectors::Random& random) {
  const SampleRange range = range_of(in);
  SamplePlane plane(in["width"], in["height"]);
  const uint32_t noise = 1u << random.below(static_cast<uint64_t>(int{in["depth"]}) + 2);
  const uint32_t slope = random.below(static_cast<uint64_t>(range.bound) / 2);
  for (size_t i = 0; i < plane.samples.size(); ++i) {
    const auto at = static_cast<int32_t>(slope * (i % plane.width));
    const int32_t sample = range.lo + at + static_cast<int32_t>(random.below(noise));
    plane.samples[i] = narrow<int16_t>(clamp(sample, range.lo, range.hi));
  }
  const SamplePrecision precision = precision_of(in);
  const uint32_t error = 1u << random.below(12);
  const auto coded = random.chance(250) ? encode_jpeg2000(plane, precision)
                                        : encode_jpeg2000_lossy(plane, precision, error);
  if (!coded) throw std::bad_alloc();
  return *coded;
}

std::string decode_plane(const Inputs& in) {
  const auto plane = decode_jpeg2000(in.bytes, in["width"], in["height"]);
  if (!plane) throw std::bad_alloc();  // the codestream is one of OpenJPEG's own
  const SampleRange range = range_of(in);
  std::vector<int32_t> samples;
  for (const int32_t sample : plane->samples) samples.push_back(clamp(sample, range.lo, range.hi));
  return joined(samples);
}

}  // namespace

std::vector<Primitive> key_primitives() {
  return {
      {"coefficient",
       "EXT-6",
       {within("b", 0, 14), within("minus", 0, 1), within("m", 0, 255)},
       {},
       "coefficient",
       kAll,
       reconstruct_coefficient},
      {"key-plane",
       "KEY-2 EXT-6",
       {depth_column(), plane_column(), within("width", 1, 12), within("height", 1, 12)},
       {"a JPEG 2000 codestream", draw_codestream},
       "samples, row by row",
       200,
       decode_plane},
  };
}

}  // namespace hmlfc::primitives
