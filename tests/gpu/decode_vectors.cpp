// Decodes the conformance vectors with the GPU decoder, kernels replaced where asked, until one
// comes out wrong: prints `ID: REASON`. Every buffer ends at a page that nobody may touch, so a
// kernel that reads or writes past its buffers ends the process.
//
// Exit: 0 all vectors passed, 1 one failed, 2 nothing can be read, 77 no device can guard its
// buffers; those of CLI11 for wrong usage.
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <hmlfc/gpu/decoder.hpp>

#include "bits/crc32c.hpp"
#include "decoder/open_stream.hpp"
#include "gpu/kernel_files.hpp"
#include "io/files.hpp"
#include "vectors/digest.hpp"
#include "vectors/manifest.hpp"

namespace {

using hmlfc::ErrorCode;
using hmlfc::RgbImage;
using hmlfc::StreamHeader;
using hmlfc::StreamView;
using hmlfc::ViewPos;
using hmlfc::gpu::BlockArea;
using hmlfc::gpu::Device;
using hmlfc::gpu::DeviceOptions;
using hmlfc::gpu::GpuDecoder;
using hmlfc::gpu::PixelArea;
using hmlfc::gpu::PixelBlocks;
using hmlfc::vectors::Vector;

constexpr int kPassed = 0;
constexpr int kFailed = 1;
constexpr int kUnreadable = 2;
constexpr int kSkipped = 77;

struct Options {
  std::filesystem::path suite;
  DeviceOptions device;
  std::filesystem::path kernels;  // empty: the library's own
  std::vector<std::string> ids;   // none: all vectors
};

// Block `number` of the pixels as an image, cropped to width x height.
RgbImage block_image(const PixelBlocks& pixels, size_t number, const StreamHeader& header,
                     uint32_t width, uint32_t height) {
  const uint32_t side = header.block_size();
  RgbImage image{width, height, static_cast<int>(header.depth), {}};
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      for (uint32_t lane = 0; lane < 3; ++lane) {
        const size_t at = ((number * 3 + lane) * side + y) * side + x;
        image.samples.push_back(static_cast<uint16_t>(pixels.samples[at]));
      }
    }
  }
  return image;
}

// The lines of the blocks file (vectors/README.md) of one view, whose first block is `number`.
std::string blocks_of_view(const PixelBlocks& pixels, size_t number, const StreamHeader& header,
                           ViewPos view) {
  const uint32_t side = header.block_size();
  std::string sums;
  for (uint32_t y = 0; y < header.height; y += side) {
    for (uint32_t x = 0; x < header.width; x += side, ++number) {
      if (!sums.empty()) sums += ' ';
      const RgbImage image = block_image(pixels, number, header, std::min(side, header.width - x),
                                         std::min(side, header.height - y));
      sums += pixels.statuses[number] == 0
                  ? fmt::format("{:08x}", hmlfc::crc32c(hmlfc::vectors::picture_bytes(image)))
                  : "--------";
    }
  }
  return fmt::format("{} {}\n{}\n", view.row, view.col, sums);
}

// All views as the suite's blocks file: a checksum covers every sample.
hmlfc::gpu::Outcome<std::string> decode_blocks(GpuDecoder& decoder, const StreamView& stream) {
  const StreamHeader& header = stream.header;
  const hmlfc::PlaneShape& luma = stream.geometry.plane(hmlfc::Plane::kY);
  std::vector<PixelArea> areas;
  for (uint32_t row = 0; row < header.rows; ++row) {
    for (uint32_t col = 0; col < header.cols; ++col) {
      areas.push_back({{row, col}, 0, 0, luma.blocks_x, luma.blocks_y, 0});
    }
  }
  const auto pixels = decoder.decode_rgb(areas);
  if (!pixels) return tl::unexpected(pixels.error());
  std::string text;
  for (size_t i = 0; i < areas.size(); ++i) {
    const size_t first = i * luma.blocks_x * luma.blocks_y;
    text += blocks_of_view(*pixels, first, header, areas[i].view);
  }
  return text;
}

// Whether each block that must fail does so with the error; else what is wrong.
std::string check_errors(GpuDecoder& decoder, const Vector& vector) {
  for (const hmlfc::BlockAddress& block : vector.expect.blocks) {
    const BlockArea area{block.view, block.plane, block.bx, block.by, 1, 1, 0};
    const auto blocks = decoder.decode(std::span(&area, 1));
    if (!blocks) return blocks.error().message;
    const auto error = static_cast<ErrorCode>(blocks->statuses.front());
    if (error != vector.expect.error) {
      return fmt::format("{} instead of {}", hmlfc::error_name(error),
                         hmlfc::error_name(vector.expect.error));
    }
  }
  return {};
}

// What is wrong with the vector's decoded form; empty where nothing is.
std::string check(Device& device, const std::filesystem::path& suite, const Vector& vector) {
  const auto file = hmlfc::io::map_file(suite / vector.input.file);
  if (!file) return file.error().message;
  const auto stream = hmlfc::open_stream(file->bytes(), {});
  // What opening refuses never comes to a shader.
  if (!stream) return vector.expect.error == stream.error().code ? "" : "it does not open";
  auto decoder = GpuDecoder::open(device, *stream);
  if (!decoder) return decoder.error().message;
  const auto blocks = decode_blocks(*decoder, *stream);
  if (!blocks) return blocks.error().message;
  const std::span bytes(reinterpret_cast<const uint8_t*>(blocks->data()), blocks->size());
  if (!vector.blocks) return "the suite has no checksums of its blocks";
  if (hmlfc::vectors::sha256(bytes) != vector.blocks->sha256) return "wrong blocks";
  return check_errors(*decoder, vector);
}

const std::string& id_of(const Vector& vector) { return vector.id.text(); }

int run(const Options& options) {
  const auto manifest = hmlfc::vectors::read_manifest(options.suite);
  if (!manifest) throw std::runtime_error(manifest.error().message);
  auto device = Device::open(options.device);
  if (!device) {
    fmt::print(stderr, "{}\n", device.error().message);
    return kSkipped;
  }
  std::vector<std::string> ids = options.ids;
  if (ids.empty()) {
    std::ranges::transform(manifest->vectors, std::back_inserter(ids), id_of);
  }
  for (const std::string& id : ids) {
    const auto vector = std::ranges::find(manifest->vectors, id, id_of);
    if (vector == manifest->vectors.end()) throw std::runtime_error("the suite has no " + id);
    const std::string wrong = check(*device, options.suite, *vector);
    if (!wrong.empty()) {
      fmt::print("{}: {}\n", id, wrong);
      return kFailed;
    }
  }
  return kPassed;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  options.device.guard_pages = true;
  if (const char* name = std::getenv("HMLFC_GPU_DEVICE")) options.device.device = name;
  CLI::App app{"Decodes conformance vectors with the GPU decoder, until one comes out wrong"};
  app.add_option("SUITE", options.suite)->required();
  app.add_option("--kernels", options.kernels, "Folder of NAME.spv, instead of the library's own");
  app.add_option("--vector", options.ids, "Only these");
  CLI11_PARSE(app, argc, argv);
  try {
    if (!options.kernels.empty()) {
      options.device.kernels = hmlfc::gpu::read_kernels(options.kernels);
    }
    return run(options);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return kUnreadable;
  }
}
