#include <algorithm>
#include <cmath>
#include <vector>

#include <hmlfc/measure.hpp>

#include "common/timing.hpp"
#include "decoder/openjpeg_sink.hpp"
#include "render/peers.hpp"

namespace hmlfc::bench {
namespace {

using openjpeg::Codec;
using openjpeg::Image;
using openjpeg::Stream;

Image image_of(const RgbImage& picture) {
  opj_image_cmptparm_t parameters[3] = {};
  for (auto& parameter : parameters) {
    parameter.dx = parameter.dy = 1;
    parameter.w = picture.width;
    parameter.h = picture.height;
    parameter.prec = 8;
  }
  Image image(opj_image_create(3, parameters, OPJ_CLRSPC_SRGB));
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
  const Codec codec(opj_create_compress(OPJ_CODEC_J2K));
  openjpeg::Sink sink;
  const Stream stream = openjpeg::open_sink(sink);
  if (!opj_setup_encoder(codec.get(), &parameters, image.get()) ||
      !opj_start_compress(codec.get(), image.get(), stream.get()) ||
      !opj_encode(codec.get(), stream.get()) || !opj_end_compress(codec.get(), stream.get())) {
    return std::nullopt;
  }
  return std::move(sink.bytes);
}

std::optional<RgbImage> decode(const std::vector<uint8_t>& bytes) {
  openjpeg::Source source{bytes};
  const Stream stream = openjpeg::open_source(source);
  const Codec codec(opj_create_decompress(OPJ_CODEC_J2K));
  opj_dparameters_t parameters;
  opj_set_default_decoder_parameters(&parameters);
  opj_image_t* raw = nullptr;
  if (!opj_setup_decoder(codec.get(), &parameters) ||
      !opj_read_header(stream.get(), codec.get(), &raw)) {
    return std::nullopt;
  }
  const Image image(raw);
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
  double low = 2;     // ratios: of this one the PSNR suffices
  double high = 200;  // of this one it does not
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
