#include "key_planes.hpp"

#include <algorithm>
#include <memory>
#include <new>
#include <vector>

#include "arithmetic/rounding.hpp"
#include "bits/parallel.hpp"
#include "decoder/key_images.hpp"
#include "device/arguments.hpp"
#include "source_parts.hpp"

namespace hmlfc::gpu {
namespace {

constexpr size_t kPlanesAtOnce = 48;  // that are decoded and held

// One plane of one key image.
struct KeyPlane {
  int level;
  ImagePos image;
  Plane plane;
  uint64_t word;  // of the reference area
};

std::vector<KeyPlane> key_planes(const StreamView& stream, const StreamShapeRecord& shape) {
  std::vector<KeyPlane> planes;
  for (int l = 0; l <= stream.geometry.top(); ++l) {
    const LevelShape& level = stream.geometry.level(l);
    if (!level.keyed) continue;
    for (uint32_t g = 0; g < level.group_rows() * level.group_cols(); ++g) {
      const ImagePos image =
          stream.geometry.reference_of_group(l, {g / level.group_cols(), g % level.group_cols()});
      const uint64_t number = shape.levels[static_cast<size_t>(l)].first_reference + uint64_t{g};
      for (const Plane plane : kPlanes) {
        const uint64_t first = shape.planes[static_cast<size_t>(plane)].first_word;
        planes.push_back({l, image, plane, number * shape.reference_words + first});
      }
    }
  }
  return planes;
}

// A plane as the area holds it.
struct PackedPlane {
  std::vector<uint8_t> bytes;
  bool damaged = false;
};

// A plane that is not there is damaged; want of memory is thrown.
PackedPlane pack(const Result<std::shared_ptr<const SamplePlane>>& plane, const PlaneShape& shape) {
  const size_t stride = 2 * size_t{ceil_div(shape.width, 2u)};
  PackedPlane packed;
  packed.damaged = !plane;
  if (!plane && plane.error().code == ErrorCode::kOutOfMemory) throw std::bad_alloc();
  const int32_t fill = plane ? 0 : kErrorSample + static_cast<int32_t>(plane.error().code);
  std::vector<int16_t> samples(stride * shape.height, static_cast<int16_t>(fill));
  for (uint32_t y = 0; plane && y < shape.height; ++y) {
    const auto row = (*plane)->row(y);
    std::ranges::copy(row, samples.begin() + static_cast<ptrdiff_t>(y * stride));
  }
  for (const int16_t sample : samples) {
    packed.bytes.push_back(static_cast<uint8_t>(sample));
    packed.bytes.push_back(static_cast<uint8_t>(static_cast<uint16_t>(sample) >> 8));
  }
  return packed;
}

}  // namespace

size_t pack_key_planes(
    const StreamView& stream, const StreamShapeRecord& shape,
    const std::function<void(uint64_t word, std::span<const uint8_t> bytes)>& use) {
  const auto planes = key_planes(stream, shape);
  size_t damaged = 0;
  for (size_t begin = 0; begin < planes.size(); begin += kPlanesAtOnce) {
    const size_t count = std::min(kPlanesAtOnce, planes.size() - begin);
    std::vector<PackedPlane> packed(count);
    read_part(stream, [&](const StreamView& view) {
      const KeyImages keys(view);
      parallel_for(count, [&](size_t i) {
        const KeyPlane& key = planes[begin + i];
        packed[i] =
            pack(keys.plane(key.level, key.image, key.plane), stream.geometry.plane(key.plane));
      });
    });
    for (size_t i = 0; i < count; ++i) {
      if (packed[i].damaged) ++damaged;
      use(planes[begin + i].word, packed[i].bytes);
    }
  }
  return damaged;
}

}  // namespace hmlfc::gpu
