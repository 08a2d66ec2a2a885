#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

#include <openjpeg.h>

#include <hmlfc/measure.hpp>

#include "render/peers.hpp"
#include "render/timing.hpp"

namespace hmlfc::bench {
namespace {

// Bytes that OpenJPEG reads or writes.
struct Memory {
  std::vector<uint8_t> bytes;
  size_t at = 0;
};

OPJ_SIZE_T write_memory(void* data, OPJ_SIZE_T size, void* user) {
  auto& memory = *static_cast<Memory*>(user);
  memory.bytes.resize(std::max(memory.bytes.size(), memory.at + size));
  std::memcpy(memory.bytes.data() + memory.at, data, size);
  memory.at += size;
  return size;
}

OPJ_SIZE_T read_memory(void* data, OPJ_SIZE_T size, void* user) {
  auto& memory = *static_cast<Memory*>(user);
  const size_t part = std::min<size_t>(size, memory.bytes.size() - memory.at);
  if (part == 0) return static_cast<OPJ_SIZE_T>(-1);
  std::memcpy(data, memory.bytes.data() + memory.at, part);
  memory.at += part;
  return part;
}

OPJ_OFF_T skip_memory(OPJ_OFF_T size, void* user) {
  static_cast<Memory*>(user)->at += static_cast<size_t>(size);
  return size;
}

OPJ_BOOL seek_memory(OPJ_OFF_T at, void* user) {
  static_cast<Memory*>(user)->at = static_cast<size_t>(at);
  return OPJ_TRUE;
}

using Stream = std::unique_ptr<opj_stream_t, decltype(&opj_stream_destroy)>;
using Codec = std::unique_ptr<opj_codec_t, decltype(&opj_destroy_codec)>;
using Image = std::unique_ptr<opj_image_t, decltype(&opj_image_destroy)>;

Stream stream_on(Memory& memory, bool reads) {
  Stream stream(opj_stream_default_create(reads ? OPJ_TRUE : OPJ_FALSE), &opj_stream_destroy);
  opj_stream_set_user_data(stream.get(), &memory, nullptr);
  opj_stream_set_user_data_length(stream.get(), memory.bytes.size());
  opj_stream_set_write_function(stream.get(), write_memory);
  opj_stream_set_read_function(stream.get(), read_memory);
  opj_stream_set_skip_function(stream.get(), skip_memory);
  opj_stream_set_seek_function(stream.get(), seek_memory);
  return stream;
}

Image image_of(const RgbImage& picture) {
  opj_image_cmptparm_t parameters[3] = {};
  for (auto& parameter : parameters) {
    parameter.dx = parameter.dy = 1;
    parameter.w = picture.width;
    parameter.h = picture.height;
    parameter.prec = 8;
  }
  Image image(opj_image_create(3, parameters, OPJ_CLRSPC_SRGB), &opj_image_destroy);
  image->x1 = picture.width;
  image->y1 = picture.height;
  for (size_t i = 0; i < picture.samples.size(); ++i) {
    image->comps[i % 3].data[i / 3] = picture.samples[i];
  }
  return image;
}

std::optional<std::vector<uint8_t>> encode(const RgbImage& picture, double ratio) {
  opj_cparameters_t parameters;
  opj_set_default_encoder_parameters(&parameters);
  parameters.irreversible = 1;
  parameters.tcp_mct = 1;
  parameters.tcp_numlayers = 1;
  parameters.cp_disto_alloc = 1;
  parameters.tcp_rates[0] = static_cast<float>(ratio);
  const Image image = image_of(picture);
  const Codec codec(opj_create_compress(OPJ_CODEC_J2K), &opj_destroy_codec);
  Memory memory;
  const Stream stream = stream_on(memory, false);
  if (!opj_setup_encoder(codec.get(), &parameters, image.get()) ||
      !opj_start_compress(codec.get(), image.get(), stream.get()) ||
      !opj_encode(codec.get(), stream.get()) || !opj_end_compress(codec.get(), stream.get())) {
    return std::nullopt;
  }
  return std::move(memory.bytes);
}

std::optional<RgbImage> decode(const std::vector<uint8_t>& bytes) {
  Memory memory{bytes, 0};
  const Stream stream = stream_on(memory, true);
  const Codec codec(opj_create_decompress(OPJ_CODEC_J2K), &opj_destroy_codec);
  opj_dparameters_t parameters;
  opj_set_default_decoder_parameters(&parameters);
  opj_image_t* raw = nullptr;
  if (!opj_setup_decoder(codec.get(), &parameters) ||
      !opj_read_header(stream.get(), codec.get(), &raw)) {
    return std::nullopt;
  }
  const Image image(raw, &opj_image_destroy);
  if (!opj_decode(codec.get(), stream.get(), image.get())) return std::nullopt;
  RgbImage picture{image->comps[0].w, image->comps[0].h, 8, {}};
  picture.samples.resize(size_t{picture.width} * picture.height * 3);
  for (size_t i = 0; i < picture.samples.size(); ++i) {
    picture.samples[i] = static_cast<uint16_t>(std::clamp(image->comps[i % 3].data[i / 3], 0, 255));
  }
  return picture;
}

}  // namespace

std::optional<Peer> openjpeg_peer(const RgbImage& image, double target) {
  double low = 2;     // a ratio that reaches the target
  double high = 200;  // a ratio that does not
  for (int step = 0; step < 10; ++step) {
    const double ratio = std::sqrt(low * high);
    const auto bytes = encode(image, ratio);
    const auto decoded = bytes ? decode(*bytes) : std::nullopt;
    if (!decoded) return std::nullopt;
    const double reached = psnr(measure(image, *decoded).rgb_squares, image.samples.size(), 8);
    (reached >= target ? low : high) = ratio;
  }
  const auto bytes = encode(image, low);
  auto decoded = bytes ? decode(*bytes) : std::nullopt;
  if (!decoded) return std::nullopt;
  const double seconds = cpu_seconds_of([&] { (void)decode(*bytes); });
  return Peer{"OpenJPEG", seconds, std::move(*decoded)};
}

}  // namespace hmlfc::bench
