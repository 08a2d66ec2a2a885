// For every conformance vector that opens: what the decoder in WGSL needs besides it, and blocks
// that it has to give.
//
// usage: reference_areas SUITE FOLDER
//
// Writes FOLDER/N.area, N the number of the vector in the manifest, as `hmlfc reference-area` does,
// and FOLDER/N.blocks in 16-bit words, the low byte first: all blocks of three planes of the first
// view at every stop level, from 0 on, and of the last view: the error, then B * B samples of the
// golden model, kOutside where they lie outside the plane.
//
// Exit: 0, 2 something cannot be read or written, 77 this build has no GPU decoder.
#include <cstdio>
#include <filesystem>
#include <vector>

#include <fmt/format.h>

#include <hmlfc/decoder.hpp>
#include <hmlfc/gpu/reference_area.hpp>

#include "io/files.hpp"
#include "vectors/manifest.hpp"

namespace {

using hmlfc::Decoder;
using hmlfc::Plane;

constexpr uint16_t kOutside = 0x7FFF;  // no sample
constexpr int kSkipped = 77;

void append(std::vector<uint8_t>& bytes, int32_t word) {
  bytes.push_back(static_cast<uint8_t>(word));
  bytes.push_back(static_cast<uint8_t>(word >> 8));
}

void append_block(const Decoder& decoder, const hmlfc::BlockAddress& block, int stop_level,
                  std::vector<uint8_t>& bytes) {
  const uint32_t side = decoder.header().block_size();
  const hmlfc::PlaneSize size = decoder.plane_size(block.plane);
  const auto samples = decoder.decode_block(block, {.stop_level = stop_level});
  append(bytes, samples ? 0 : static_cast<int32_t>(samples.error().code));
  for (uint32_t i = 0; i < side * side; ++i) {
    const bool inside =
        block.bx * side + i % side < size.width && block.by * side + i / side < size.height;
    append(bytes, !inside ? kOutside : samples ? (*samples)[i] : 0);
  }
}

void append_view(const Decoder& decoder, hmlfc::ViewPos view, int stop_level,
                 std::vector<uint8_t>& bytes) {
  const uint32_t side = decoder.header().block_size();
  for (const Plane plane : hmlfc::kPlanes) {
    const hmlfc::PlaneSize size = decoder.plane_size(plane);
    for (uint32_t by = 0; by * side < size.height; ++by) {
      for (uint32_t bx = 0; bx * side < size.width; ++bx) {
        append_block(decoder, {view, plane, bx, by}, stop_level, bytes);
      }
    }
  }
}

std::vector<uint8_t> blocks_of(const Decoder& decoder) {
  const hmlfc::StreamHeader& header = decoder.header();
  std::vector<uint8_t> bytes;
  for (int level = 0; level <= static_cast<int>(header.tree_height); ++level) {
    append_view(decoder, {0, 0}, level, bytes);
  }
  append_view(decoder, {header.rows - 1u, header.cols - 1u}, 0, bytes);
  return bytes;
}

template <class Value, class Error>
Value value_or_throw(tl::expected<Value, Error> result) {
  if (!result) throw std::runtime_error(result.error().message);
  if constexpr (!std::is_void_v<Value>) return std::move(*result);
}

int run(const std::filesystem::path& suite, const std::filesystem::path& folder) {
  const auto manifest = value_or_throw(hmlfc::vectors::read_manifest(suite));
  for (size_t i = 0; i < manifest.vectors.size(); ++i) {
    const auto file = value_or_throw(hmlfc::io::map_file(suite / manifest.vectors[i].input.file));
    const auto decoder = Decoder::open(file.bytes());
    if (!decoder) continue;
    const auto area = hmlfc::gpu::reference_area(*decoder);
    if (!area) {
      fmt::print("skipped: {}\n", area.error().message);
      return area.error().kind == hmlfc::gpu::FailureKind::kUnusable ? kSkipped : 2;
    }
    value_or_throw(hmlfc::io::write_file(folder / fmt::format("{}.area", i), *area));
    value_or_throw(
        hmlfc::io::write_file(folder / fmt::format("{}.blocks", i), blocks_of(*decoder)));
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    return run(argv[1], argv[2]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
