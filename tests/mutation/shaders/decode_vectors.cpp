// Decodes the conformance vectors with the GPU decoder, kernels replaced where asked, until one
// comes out wrong. The last line of stdout says how it ended: `passed N` or `failed ID: REASON`.
//
// Every buffer ends at a page that nobody may touch: a kernel that reads or writes past its buffers
// ends the process.
//
// Usage: decode_vectors SUITE [--chunk-bytes N] [--kernel NAME=FILE.spv]... [--vector ID]...
// Exit: 0 all vectors passed, 1 one failed, 2 wrong usage, 77 no device can guard its buffers.
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "bits/crc32c.hpp"
#include "decoder/open_stream.hpp"
#include "gpu_decoder.hpp"
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
constexpr int kUsage = 2;
constexpr int kSkipped = 77;

struct Options {
  std::filesystem::path suite;
  DeviceOptions device;
  std::vector<std::string> ids;  // none: all vectors
};

std::optional<std::vector<uint32_t>> read_words(const std::filesystem::path& path) {
  const auto file = hmlfc::io::MappedFile::open(path);
  if (!file || file->bytes().size() % 4 != 0) return std::nullopt;
  std::vector<uint32_t> words(file->bytes().size() / 4);
  std::memcpy(words.data(), file->bytes().data(), file->bytes().size());
  return words;
}

bool add_kernel(std::string_view argument, Options& options) {
  const size_t equals = argument.find('=');
  if (equals == std::string_view::npos) return false;
  auto words = read_words(argument.substr(equals + 1));
  if (!words) return false;
  options.device.kernels[std::string(argument.substr(0, equals))] = std::move(*words);
  return true;
}

std::optional<Options> parse(const std::vector<std::string>& arguments) {
  if (arguments.size() % 2 != 1) return std::nullopt;
  Options options;
  options.suite = arguments.front();
  options.device.guard_pages = true;
  if (const char* name = std::getenv("HMLFC_GPU_DEVICE")) options.device.device = name;
  for (size_t i = 1; i < arguments.size(); i += 2) {
    const std::string& value = arguments[i + 1];
    if (arguments[i] == "--kernel") {
      if (!add_kernel(value, options)) return std::nullopt;
    } else if (arguments[i] == "--vector") {
      options.ids.push_back(value);
    } else if (arguments[i] == "--chunk-bytes") {
      std::from_chars(value.data(), value.data() + value.size(), options.device.chunk_bytes);
    } else {
      return std::nullopt;
    }
  }
  return options;
}

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

// All views, as the suite keeps them.
struct DecodedViews {
  std::vector<uint8_t> raw;
  std::string blocks;
  bool all_decode = true;
};

// The bytes of a view are those of its rows, which go through blocks.
void append_raw(const PixelBlocks& pixels, size_t number, const StreamHeader& header,
                std::vector<uint8_t>& raw) {
  const uint32_t side = header.block_size();
  const size_t columns = (header.width + side - 1) / side;
  RgbImage image{header.width, header.height, static_cast<int>(header.depth), {}};
  for (uint32_t y = 0; y < header.height; ++y) {
    for (uint32_t x = 0; x < header.width; ++x) {
      const size_t block = number + y / side * columns + x / side;
      for (uint32_t lane = 0; lane < 3; ++lane) {
        const size_t at = ((block * 3 + lane) * side + y % side) * side + x % side;
        image.samples.push_back(static_cast<uint16_t>(pixels.samples[at]));
      }
    }
  }
  const auto bytes = hmlfc::vectors::picture_bytes(image);
  raw.insert(raw.end(), bytes.begin(), bytes.end());
}

hmlfc::gpu::Outcome<DecodedViews> decode_views(GpuDecoder& decoder, const StreamView& stream) {
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
  DecodedViews views;
  const size_t blocks = size_t{luma.blocks_x} * luma.blocks_y;
  for (size_t i = 0; i < areas.size(); ++i) {
    views.blocks += blocks_of_view(*pixels, i * blocks, header, areas[i].view);
    append_raw(*pixels, i * blocks, header, views.raw);
  }
  views.all_decode = std::ranges::all_of(pixels->statuses, [](uint8_t s) { return s == 0; });
  return views;
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
  const auto file = hmlfc::io::MappedFile::open(suite / vector.input.file);
  if (!file) return file.error().message;
  const auto stream = hmlfc::open_stream(file->bytes(), {});
  // What opening refuses never comes to a shader.
  if (!stream) return vector.expect.error == stream.error().code ? "" : "it does not open";
  auto decoder = GpuDecoder::open(device, *stream);
  if (!decoder) return decoder.error().message;
  const auto views = decode_views(*decoder, *stream);
  if (!views) return views.error().message;
  using hmlfc::vectors::sha256;
  if (vector.output && !views->all_decode) return "a block does not decode";
  if (vector.output && sha256(views->raw) != vector.output->sha256) return "wrong samples";
  const std::span blocks(reinterpret_cast<const uint8_t*>(views->blocks.data()),
                         views->blocks.size());
  if (vector.blocks && sha256(blocks) != vector.blocks->sha256) return "wrong blocks";
  return check_errors(*decoder, vector);
}

int run(const Options& options) {
  const auto manifest = hmlfc::vectors::read_manifest(options.suite);
  if (!manifest) {
    std::fprintf(stderr, "%s\n", manifest.error().message.c_str());
    return kUsage;
  }
  auto device = Device::open(options.device);
  if (!device) {
    std::fprintf(stderr, "%s\n", device.error().message.c_str());
    return kSkipped;
  }
  std::vector<std::string> ids = options.ids;
  if (ids.empty()) {
    std::ranges::transform(manifest->vectors, std::back_inserter(ids), &Vector::id);
  }
  for (const std::string& id : ids) {
    const auto vector = std::ranges::find(manifest->vectors, id, &Vector::id);
    if (vector == manifest->vectors.end()) {
      std::fprintf(stderr, "the suite has no vector %s\n", id.c_str());
      return kUsage;
    }
    const std::string wrong = check(*device, options.suite, *vector);
    if (!wrong.empty()) {
      std::printf("failed %s: %s\n", id.c_str(), wrong.c_str());
      return kFailed;
    }
  }
  std::printf("passed %zu\n", ids.size());
  return kPassed;
}

}  // namespace

int main(int argc, char** argv) {
  const auto options = parse({argv + 1, argv + argc});
  if (!options) {
    std::fprintf(stderr,
                 "usage: decode_vectors SUITE [--chunk-bytes N] [--kernel NAME=FILE.spv]... "
                 "[--vector ID]...\n");
    return kUsage;
  }
  return run(*options);
}
