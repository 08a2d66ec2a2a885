#include <hmlfc/gpu/reference_area.hpp>

#include <bit>
#include <cstring>

#include "arithmetic/rounding.hpp"
#include "batch.hpp"
#include "bits/little_endian.hpp"
#include "decoder/open_stream.hpp"
#include "device/device_state.hpp"
#include "key_planes.hpp"
#include "stream_shape.hpp"
#include "syntax/header.hpp"

namespace hmlfc::gpu {
namespace {

constexpr uint32_t kMagic = 0x41524C48;  // "HLRA"
constexpr uint32_t kVersion = 1;
constexpr uint64_t kBatchRequests = uint64_t{1} << 20;  // of a batch of reference images
constexpr uint32_t kNoChunks = 31;                      // log2 of words that no buffer has

// HEADER of hmlfc_gpu.js has the same members in the same order.
struct Header {
  uint32_t magic = kMagic;
  uint32_t version = kVersion;
  uint32_t header_bytes, header_crc;   // of the stream
  uint32_t coded_offset, coded_bytes;  // of ROOT, GROUP and TILE in the stream
  uint32_t area_words;
  uint32_t damaged = 0;  // planes of key images that do not decode
  uint32_t shape_words = sizeof(StreamShapeRecord) / 4;
  uint32_t batches, runs = 0;
  uint32_t rows, cols, width, height, depth, block_log2, levels, chroma_halved;
  uint32_t blocks_x, blocks_y;  // of plane Y
};

uint32_t checked(uint64_t bytes, const char* what) {
  if (bytes <= UINT32_MAX) return static_cast<uint32_t>(bytes);
  throw MachineError(FailureKind::kLimit,
                     std::string("limit_exceeded: ") + what + " takes 4 GiB or more");
}

// Records of 32-bit words, and their bytes.
template <class Record>
void append(std::vector<uint8_t>& bytes, const Record& record) {
  static_assert(std::endian::native == std::endian::little && sizeof(Record) % 4 == 0);
  const size_t before = bytes.size();
  bytes.resize(before + sizeof(Record));
  std::memcpy(bytes.data() + before, &record, sizeof(Record));
}

Header header_of(const StreamView& stream, size_t batches) {
  const StreamHeader& header = stream.header;
  const PlaneShape& luma = stream.geometry.plane(Plane::kY);
  Header record{};
  record.header_bytes = header_size(header);
  record.header_crc = load_le<uint32_t>(stream.file, record.header_bytes - 4);
  const ByteRange coded = coded_range(stream);
  record.coded_offset = checked(coded.offset, "the stream");
  record.coded_bytes = checked(coded.bytes + 4, "the stream") - 4;
  record.area_words =
      checked(4 * reference_count(stream.geometry) * reference_words(stream.geometry),
              "the reference area") /
      4;
  record.batches = static_cast<uint32_t>(batches);
  record.rows = header.rows;
  record.cols = header.cols;
  record.width = header.width;
  record.height = header.height;
  record.depth = static_cast<uint32_t>(header.depth);
  record.block_log2 = header.block_log2;
  record.levels = static_cast<uint32_t>(header.tree_height) + 1;
  record.chroma_halved = header.chroma_format == ChromaFormat::k420 ? 1 : 0;
  record.blocks_x = luma.blocks_x;
  record.blocks_y = luma.blocks_y;
  return record;
}

}  // namespace

Outcome<std::vector<uint8_t>> reference_area(const StreamView& stream) {
  return guard_device([&] {
    const auto batches = reference_batches(stream.geometry, kBatchRequests);
    Header header = header_of(stream, batches.size());
    const StreamShapeRecord shape = stream_shape(stream, kNoChunks, kNoChunks);
    std::vector<uint8_t> bytes;
    append(bytes, header);
    append(bytes, shape);
    for (const Batch& batch : batches) {
      append(bytes, static_cast<uint32_t>(batch.areas.size()));
      append(bytes, static_cast<uint32_t>(batch.requests));
      for (const AreaRecord& area : batch.areas) append(bytes, area);
    }
    const auto append_run = [&](uint64_t word, std::span<const uint8_t> plane) {
      append(bytes, static_cast<uint32_t>(word));
      append(bytes, static_cast<uint32_t>(plane.size() / 4));
      bytes.insert(bytes.end(), plane.begin(), plane.end());
      ++header.runs;
    };
    header.damaged = static_cast<uint32_t>(pack_key_planes(stream, shape, append_run));
    std::memcpy(bytes.data(), &header, sizeof(header));
    return bytes;
  });
}

Outcome<std::vector<uint8_t>> reference_area(const Decoder& stream) {
  return reference_area(DecoderAccess::stream(stream));
}

}  // namespace hmlfc::gpu
