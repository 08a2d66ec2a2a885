#include "device_stream.hpp"

#include <algorithm>

#include "arithmetic/rounding.hpp"
#include "batch_buffers.hpp"
#include "bits/parallel.hpp"
#include "commands.hpp"
#include "decoder/key_images.hpp"
#include "stream_shape.hpp"

namespace hmlfc::gpu {
namespace {

constexpr size_t kPlanesAtOnce = 48;  // key planes decoded before they are uploaded

// Samples of an error: the number less 2^15 (reference_samples.glsl).
constexpr int32_t kErrorSample = -32768;

// The sections ROOT, GROUP and TILE, which follow each other in the file.
std::span<const uint8_t> coded_bytes(const StreamView& stream) {
  const SectionEntry& root = stream.entry(Section::kRoot);
  const SectionEntry& tile = stream.entry(Section::kTile);
  return stream.file.subspan(static_cast<size_t>(root.offset),
                             static_cast<size_t>(tile.offset + tile.size - root.offset));
}

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

PackedPlane pack(const Result<std::shared_ptr<const SamplePlane>>& plane, const PlaneShape& shape) {
  const size_t stride = 2 * size_t{ceil_div(shape.width, 2u)};
  PackedPlane packed;
  packed.damaged = !plane;
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

DeviceStream::DeviceStream(Device::State& device, const StreamView& stream)
    : words_(device, ceil_div<uint64_t>(coded_bytes(stream).size(), 4)),
      references_(device, reference_count(stream.geometry) * reference_words(stream.geometry)),
      shape_record_(stream_shape(stream, words_.chunk_log2(), references_.chunk_log2())),
      shape_(device, sizeof(StreamShapeRecord), Memory::kDevice),
      damage_(device, sizeof(uint32_t), Memory::kDevice) {
  words_.upload(device, 0, coded_bytes(stream));
  upload(device, bytes_of(std::span(&shape_record_, 1)), shape_);
  upload_keys(device, stream);
  decode_references(device, stream);
}

Arguments DeviceStream::arguments() const {
  Arguments arguments;
  arguments.shape = shape_.address();
  arguments.stream = words_.address(chunked());
  arguments.references = references_.address(chunked());
  arguments.damage = damage_.address();
  return arguments;
}

void DeviceStream::upload_keys(Device::State& device, const StreamView& stream) {
  const auto planes = key_planes(stream, shape_record_);
  uint32_t damage = 0;
  for (size_t begin = 0; begin < planes.size(); begin += kPlanesAtOnce) {
    const size_t count = std::min(kPlanesAtOnce, planes.size() - begin);
    const KeyImages keys(stream);
    std::vector<PackedPlane> packed(count);
    parallel_for(count, [&](size_t i) {
      const KeyPlane& key = planes[begin + i];
      packed[i] =
          pack(keys.plane(key.level, key.image, key.plane), stream.geometry.plane(key.plane));
    });
    for (size_t i = 0; i < count; ++i) {
      if (packed[i].damaged) damage = 1;
      references_.upload(device, 4 * planes[begin + i].word, packed[i].bytes);
    }
  }
  upload(device, bytes_of(std::span(&damage, 1)), damage_);
}

// Residuals of the reference images at levels that are not keyed (DEC-4).
void DeviceStream::decode_references(Device::State& device, const StreamView& stream) {
  const Variant variant = variant_of(KernelUse::kReferences, chunked());
  const BlockSizes sizes = block_sizes(stream.header);
  BatchBuffers buffers;
  const uint64_t limit = std::max<uint64_t>(1, max_requests(device, sizes, false));
  const auto batches = reference_batches(stream.geometry, limit);
  if (!batches.empty()) device.kernels->prepare(KernelUse::kReferences, chunked());
  for (const Batch& batch : batches) {
    const Arguments all = buffers.prepare(device, batch, sizes, KernelUse::kBlocks, arguments());
    Commands commands(device);
    commands.barrier(kTransfer, kCompute);  // the stream's upload
    commands.dispatch("expand", variant, all, batch.requests);
    commands.barrier(kCompute, kCompute);
    commands.dispatch("walk", variant, all, batch.requests);
    commands.barrier(kCompute, kCompute);
    commands.dispatch("residuals", variant, all, batch.requests * sizes.lanes());
    commands.run();
  }
}

}  // namespace hmlfc::gpu
