#include "decoder/jpeg2000.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <new>

#include "arithmetic/widths.hpp"
#include "decoder/openjpeg_sink.hpp"

namespace hmlfc {
namespace {

using namespace openjpeg;

Image make_image(const SamplePlane& plane, SamplePrecision precision) {
  opj_image_cmptparm_t comp{};
  comp.dx = 1;
  comp.dy = 1;
  comp.w = plane.width;
  comp.h = plane.height;
  comp.prec = static_cast<OPJ_UINT32>(precision.bits);
  comp.sgnd = precision.is_signed ? 1 : 0;
  Image image(opj_image_create(1, &comp, OPJ_CLRSPC_GRAY));
  if (!image) return image;
  image->x1 = plane.width;
  image->y1 = plane.height;
  std::copy(plane.samples.begin(), plane.samples.end(), image->comps[0].data);
  return image;
}

// One resolution for each halving of the smaller side, six at most.
int resolutions(const SamplePlane& plane) {
  int count = 1;
  for (uint32_t side = std::min(plane.width, plane.height); side > 1 && count < 6; side /= 2) {
    ++count;
  }
  return count;
}

// What OpenJPEG estimates as the PSNR with `mean_squared_error`, at the peak 2^bits - 1; 0 for
// lossless.
float psnr_of(double mean_squared_error, SamplePrecision precision) {
  if (mean_squared_error == 0) return 0;
  const double peak = static_cast<double>((1 << precision.bits) - 1);
  const double psnr = 10 * std::log10(peak * peak / mean_squared_error);
  return static_cast<float>(std::max(psnr, 1.0));
}

// Layer after layer at quality `psnr`, 0 for lossless; those before the last are each `step`
// coarser.
void set_layers(opj_cparameters_t& parameters, unsigned layers, float psnr, float step) {
  constexpr float kFinest = 40;  // of layers before a lossless one
  parameters.tcp_numlayers = static_cast<int>(layers);
  float quality = psnr > 0 ? psnr : kFinest;
  for (unsigned layer = layers - 1; layer > 0; --layer) {
    quality = std::max(quality - step, 1.0F);
    parameters.tcp_distoratio[layer - 1] = quality;
  }
  parameters.tcp_distoratio[layers - 1] = psnr;
  parameters.tcp_rates[0] = 0;  // 0 means lossless
  if (psnr > 0 || layers > 1) {
    parameters.cp_fixed_quality = 1;
  } else {
    parameters.cp_disto_alloc = 1;
  }
}

void set_options(opj_cparameters_t& parameters, const CodestreamOptions& options) {
  constexpr int kSop = 2;
  constexpr int kEph = 4;
  constexpr int kGivenPrecincts = 1;
  parameters.mode = static_cast<int>(options.style);
  parameters.prog_order = static_cast<OPJ_PROG_ORDER>(options.progression);
  parameters.csty = (options.sop ? kSop : 0) | (options.eph ? kEph : 0);
  parameters.cblockw_init = static_cast<int>(options.block_width);
  parameters.cblockh_init = static_cast<int>(options.block_height);
  if (options.decompositions) parameters.numresolution = *options.decompositions + 1;
  if (options.precinct_log2 == 0) return;
  parameters.csty |= kGivenPrecincts;
  parameters.res_spec = parameters.numresolution;
  for (int i = 0; i < parameters.res_spec; ++i) {
    parameters.prcw_init[i] = parameters.prch_init[i] = 1 << options.precinct_log2;
  }
}

// The samples, or nothing, be it for the packets or for want of memory.
std::optional<SamplePlane> try_decode(std::span<const uint8_t> codestream, uint32_t width,
                                      uint32_t height, unsigned layers) {
  constexpr int kNoOtherThread = 0;  // whatever OPJ_NUM_THREADS says
  Source source{codestream};
  const Stream stream = open_source(source);
  const Codec codec(opj_create_decompress(OPJ_CODEC_J2K));
  if (!stream || !codec) return std::nullopt;
  silence(codec.get());

  opj_dparameters_t parameters;
  opj_set_default_decoder_parameters(&parameters);
  parameters.cp_layer = layers;
  opj_image_t* raw = nullptr;
  const bool has_head = opj_setup_decoder(codec.get(), &parameters) &&
                        opj_decoder_set_strict_mode(codec.get(), OPJ_TRUE) &&
                        opj_codec_set_threads(codec.get(), kNoOtherThread) &&
                        opj_read_header(stream.get(), codec.get(), &raw);
  const Image image(raw);
  if (!has_head || !opj_decode(codec.get(), stream.get(), image.get()) ||
      !opj_end_decompress(codec.get(), stream.get())) {
    return std::nullopt;
  }
  const opj_image_comp_t& comp = image->comps[0];
  if (comp.data == nullptr || comp.w != width || comp.h != height) return std::nullopt;
  SamplePlane plane(width, height);
  std::transform(comp.data, comp.data + plane.samples.size(), plane.samples.begin(),
                 [](OPJ_INT32 sample) { return narrow<int16_t>(sample); });
  return plane;
}

}  // namespace

// OpenJPEG does not say why it fails. The C library leaves ENOMEM in errno where it could not
// allocate, and nothing else that OpenJPEG calls does.
std::optional<SamplePlane> decode_jpeg2000(std::span<const uint8_t> codestream, uint32_t width,
                                           uint32_t height, unsigned layers) {
  errno = 0;
  auto plane = try_decode(codestream, width, height, layers);
  if (!plane && errno == ENOMEM) throw std::bad_alloc();
  return plane;
}

std::optional<std::vector<uint8_t>> encode_jpeg2000(const SamplePlane& plane,
                                                    SamplePrecision precision,
                                                    const CodestreamOptions& options) {
  Sink sink;
  const Stream stream = open_sink(sink);
  const Codec codec(opj_create_compress(OPJ_CODEC_J2K));
  const Image image = make_image(plane, precision);
  if (!stream || !codec || !image) return std::nullopt;
  silence(codec.get());

  opj_cparameters_t parameters;
  opj_set_default_encoder_parameters(&parameters);
  parameters.numresolution = resolutions(plane);
  parameters.irreversible = 0;
  set_layers(parameters, options.layers, psnr_of(options.mean_squared_error, precision),
             options.layer_db);
  set_options(parameters, options);
  // The default comment names the library's version, which would make the bytes depend on it.
  char no_comment[] = "";
  parameters.cp_comment = no_comment;
  if (!opj_setup_encoder(codec.get(), &parameters, image.get()) ||
      !opj_start_compress(codec.get(), image.get(), stream.get()) ||
      !opj_encode(codec.get(), stream.get()) || !opj_end_compress(codec.get(), stream.get())) {
    return std::nullopt;
  }
  return std::move(sink.bytes);
}

}  // namespace hmlfc
