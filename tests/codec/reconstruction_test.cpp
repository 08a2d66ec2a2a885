// A decoder returns exactly what the encoder reconstructed, at every level, on every path.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>
#include <mutex>
#include <tuple>

#include <hmlfc/decoder.hpp>
#include <hmlfc/encoder.hpp>

#include "encoder/cached_views.hpp"
#include "encoder/coding_params.hpp"
#include "encoder/encode_session.hpp"
#include "scenes/test_light_fields.hpp"

namespace hmlfc {
namespace {

using ImageKey = std::tuple<int, uint32_t, uint32_t>;

// A stream with the planes that its encoder reconstructed for every image.
struct Encoding {
  std::vector<uint8_t> bytes;
  std::map<ImageKey, ImagePlanes> images;
};

Encoding encode_watched(const LightField& field, const EncodeParams& params) {
  Encoding encoding;
  std::mutex mutex;
  EncodeObserver observer;
  observer.reconstructed = [&](int level, ImagePos at, const ImagePlanes& planes) {
    const std::scoped_lock lock(mutex);
    encoding.images[{level, at.row, at.col}] = planes;
  };
  const FieldViews views(field);
  const SettledCoding settled = settle_coding(views, with_defaults(params));
  EncodeSession session(views, *header_for(field.shape(), settled.params), settled.probe);
  CodedImages coded = session.encode(settled.params, true, observer).value();
  encoding.bytes = session.stream(coded);
  return encoding;
}

// Counts the samples of one plane of one image that differ from the encoder's.
size_t differing(const Decoder& decoder, const Encoding& encoding, ViewPos view, int level,
                 Plane plane) {
  const StreamHeader& header = decoder.header();
  uint32_t row = view.row;
  uint32_t col = view.col;
  for (int l = 0; l < level; ++l) {
    row /= header.cluster_rows;
    col /= header.cluster_cols;
  }
  const SamplePlane& expected = encoding.images.at({level, row, col})[static_cast<size_t>(plane)];
  const auto decoded = decoder.decode_plane(view, plane, level);
  if (!decoded) return ~size_t{0};
  const PlaneSize size = decoder.plane_size(plane);
  size_t count = 0;
  for (uint32_t y = 0; y < size.height; ++y) {
    for (uint32_t x = 0; x < size.width; ++x) {
      count += (*decoded)[size_t{y} * size.width + x] != expected.at(x, y);
    }
  }
  return count;
}

RC_GTEST_PROP(Reconstruction, DecoderEqualsEncoderAtEveryLevel, ()) {
  const auto made = test::random_case_of_any_profile(*rc::gen::arbitrary<uint32_t>());
  const LightField field = test::textured_light_field(made.shape, 7, made.noise);
  const Encoding encoding = encode_watched(field, made.params);
  const auto decoder = Decoder::open(encoding.bytes);
  RC_ASSERT(decoder.has_value());
  const StreamHeader& header = decoder->header();
  for (int level = 0; level <= header.tree_height; ++level) {
    for (const ImagePos at : ImageRange{0, header.rows, 0, header.cols}) {
      for (const Plane plane : kPlanes) {
        RC_ASSERT(differing(*decoder, encoding, {at.row, at.col}, level, plane) == 0u);
      }
    }
  }
}

// decode_all delivers views with the error that encode() promises.
RC_GTEST_PROP(Reconstruction, MeasuredErrorEqualsPromisedError, ()) {
  const uint32_t seed = *rc::gen::arbitrary<uint32_t>();
  const auto made = test::random_case_of_any_profile(seed);
  const LightField field = test::textured_light_field(made.shape, seed, made.noise);
  const auto encoded = encode(field, made.params);
  RC_ASSERT(encoded.has_value());
  const auto decoder = Decoder::open(encoded->bytes);
  RC_ASSERT(decoder.has_value());
  ErrorSums sums;
  uint64_t views = 0;
  std::mutex mutex;
  const auto done = decoder->decode_all([&](ViewPos view, RgbImage&& image) {
    const ErrorSums error = measure(field.view(view.row, view.col), image);
    const std::scoped_lock lock(mutex);
    sums.add(error);
    ++views;
  });
  RC_ASSERT(done.has_value());
  RC_ASSERT(views == uint64_t{made.shape.rows} * made.shape.cols);
  RC_ASSERT(sums.rgb_squares == encoded->error.rgb_squares);
  RC_ASSERT(sums.y_squares == encoded->error.y_squares);
  RC_ASSERT(sums.max_abs == encoded->error.max_abs);
}

// Thresholds 0, or lossless, and 4:4:4 lose nothing, whatever the content.
RC_GTEST_PROP(Reconstruction, LosslessIsLossless, ()) {
  const uint32_t seed = *rc::gen::arbitrary<uint32_t>();
  auto made = test::random_case_of_any_profile(seed);
  made.params.chroma = ChromaFormat::k444;
  made.params.main.threshold_ref = 0;
  made.params.main.threshold_pred = 0;
  made.params.lossless = true;
  const LightField field = test::textured_light_field(made.shape, seed, made.noise);
  const auto encoded = encode(field, made.params);
  RC_ASSERT(encoded.has_value());
  const auto decoder = Decoder::open(encoded->bytes);
  RC_ASSERT(decoder.has_value());
  for (uint32_t row = 0; row < made.shape.rows; ++row) {
    for (uint32_t col = 0; col < made.shape.cols; ++col) {
      const auto view = decoder->decode_view({row, col});
      RC_ASSERT(view.has_value());
      RC_ASSERT(view->samples == field.view(row, col).samples);
    }
  }
}

}  // namespace
}  // namespace hmlfc
