#include "device_stream.hpp"

#include <algorithm>

#include "arithmetic/rounding.hpp"
#include "batch.hpp"
#include "device/submission.hpp"
#include "key_planes.hpp"
#include "source_parts.hpp"
#include "stream_shape.hpp"

namespace hmlfc::gpu {

DeviceStream::DeviceStream(Device::State& device, const StreamView& stream)
    : words_(device, ceil_div<uint64_t>(coded_range(stream).bytes, 4)),
      references_(device, reference_count(stream.geometry) * reference_words(stream.geometry)),
      shape_record_(stream_shape(stream, words_.chunk_log2(), references_.chunk_log2())),
      shape_(device, sizeof(StreamShapeRecord), Memory::kDevice),
      damage_(device, sizeof(uint32_t), Memory::kDevice) {
  upload_coded(device, stream);
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

// So that neither a partial source nor the host holds more than a part.
void DeviceStream::upload_coded(Device::State& device, const StreamView& stream) {
  const ByteRange coded = coded_range(stream);
  for (uint64_t at = 0; at < coded.bytes; at += device.upload_bytes) {
    const ByteRange part{coded.offset + at, std::min(device.upload_bytes, coded.bytes - at)};
    read_part(stream, [&](const StreamView& view) {
      if (view.source != nullptr && !is_loaded(*view.source, part)) return;
      words_.upload(
          device, at,
          view.file.subspan(static_cast<size_t>(part.offset), static_cast<size_t>(part.bytes)));
    });
  }
}

void DeviceStream::upload_keys(Device::State& device, const StreamView& stream) {
  const auto upload_plane = [&](uint64_t word, std::span<const uint8_t> bytes) {
    references_.upload(device, 4 * word, bytes);
  };
  const uint32_t damage = pack_key_planes(stream, shape_record_, upload_plane) != 0 ? 1 : 0;
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
    Submission commands(device);
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
