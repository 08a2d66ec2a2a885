#include "encoder/encode_session.hpp"

#include <algorithm>
#include <mutex>
#include <new>
#include <utility>

#include "arithmetic/rounding.hpp"
#include "arithmetic/widths.hpp"
#include "bits/parallel.hpp"
#include "decoder/jpeg2000.hpp"
#include "decoder/key_images.hpp"
#include "encoder/stream_assembly.hpp"
#include "syntax/index.hpp"

namespace hmlfc {
namespace {

// Codes plane `plane` of a key image, in place of `samples`, into `codestream`, unless it is there
// from before (KEY-2, EXT-6).
void code_key_plane(SamplePlane& samples, SamplePrecision precision, SampleRange range,
                    double error, std::vector<uint8_t>& codestream) {
  if (!codestream.empty()) return;
  auto coded = error > 0 ? encode_jpeg2000_lossy(samples, precision, error)
                         : encode_jpeg2000(samples, precision);
  if (!coded) throw std::bad_alloc();
  codestream = std::move(*coded);
  if (error == 0) return;
  auto decoded = decode_jpeg2000(codestream, samples.width, samples.height);
  if (!decoded) throw std::bad_alloc();
  samples = std::move(*decoded);
  for (int16_t& sample : samples.samples) {
    sample = static_cast<int16_t>(clamp(sample, range.lo, range.hi));
  }
}

// Everything that the levels of one encoding share.
struct Walk {
  const LightField& light_field;
  const StreamHeader& header;
  const Geometry& geometry;
  const DecisionStrategy& strategy;
  const EncodeObserver& observer;
  RkvTree& tree;
  CodedImages& coded;
  const std::vector<ImagePos>* sample;
  std::mutex error_mutex;
};

// Codes one level. Above level 0 the tree's images of the level become the reconstructed ones.
class LevelWalk {
 public:
  LevelWalk(Walk& walk, int level)
      : walk_(walk),
        geometry_(walk.geometry),
        images_(walk.light_field, walk.header, walk.geometry, walk.tree, level, walk.sample),
        decisions_(walk.strategy.begin_level(images_)) {}

  void run() {
    const auto& references = images_.references();
    const auto& predictive = images_.predictive();
    if (images_.shape().keyed && !predictive.empty()) refine_keys();
    parallel_for(references.size(), [&](size_t i) { encode_reference(i); });
    if (predictive.empty()) return;
    for (const ImagePos at : references) {
      if (has_predictive(at)) code(at)[kMotionPlane] = decisions_->decide_group(at);
    }
    parallel_for(predictive.size(), [&](size_t i) {
      const ImagePos at = predictive[i];
      finish(at, decisions_->encode_predictive(at, images_.original(at)));
    });
  }

 private:
  ImageCode& code(ImagePos at) const {
    return walk_.coded.codes[static_cast<size_t>(geometry_.image_number(images_.level(), at))];
  }

  bool has_predictive(ImagePos reference) const {
    const auto& predictive = images_.predictive();
    return std::any_of(predictive.begin(), predictive.end(), [&](ImagePos at) {
      return geometry_.reference_of(images_.level(), at) == reference;
    });
  }

  void refine_keys() {
    const auto& references = images_.references();
    keys_.resize(references.size());
    parallel_for(keys_.size(), [&](size_t i) { keys_[i] = images_.original(references[i]); });
    decisions_->refine_keys(keys_);
  }

  // Codes the i-th of references().
  void encode_reference(size_t i) {
    const ImagePos at = images_.references()[i];
    if (!images_.shape().keyed) {
      finish(at, decisions_->encode_reference(at, images_.original(at)));
      return;
    }
    EncodedImage key;
    key.samples = keys_.empty() ? images_.original(at) : std::move(keys_[i]);
    parallel_for(kPlaneCount, [&](size_t p) { encode_key(at, kPlanes[p], key.samples[p]); });
    decisions_->take_key(at, key.samples);
    finish(at, std::move(key));
  }

  // Codes one plane of a key image; `samples` become what a decoder makes of it, in whole blocks.
  void encode_key(ImagePos at, Plane plane, SamplePlane& samples) {
    const PlaneShape& shape = geometry_.plane(plane);
    const int depth = walk_.header.depth;
    const bool chroma = plane != Plane::kY;
    const uint64_t key = geometry_.key_number(images_.level(), at);
    const size_t entry = static_cast<size_t>(key) * kPlaneCount + static_cast<size_t>(plane);
    SamplePlane inside = cropped(samples, shape.width, shape.height);
    code_key_plane(inside, {depth + (chroma ? 1 : 0), chroma}, sample_range(plane, depth),
                   walk_.strategy.key_error(plane), walk_.coded.keys.codestreams[entry]);
    walk_.coded.keys.crcs[entry] = sample_crc(inside);
    samples = in_whole_blocks(inside, shape, geometry_.block_size());
  }

  void finish(ImagePos at, EncodedImage image) {
    const int level = images_.level();
    code(at) = std::move(image.code);
    if (walk_.observer.reconstructed) walk_.observer.reconstructed(level, at, image.samples);
    if (level > 0) {
      walk_.tree.at(geometry_, level, at) = std::move(image.samples);
    } else if (walk_.sample == nullptr) {
      const ErrorSums error =
          view_error(walk_.light_field, at, image.samples, walk_.header.chroma_format);
      const std::scoped_lock lock(walk_.error_mutex);
      walk_.coded.error.add(error);
    }
    if (walk_.observer.image_done) walk_.observer.image_done();
  }

  Walk& walk_;
  const Geometry& geometry_;
  LevelImages images_;
  std::unique_ptr<LevelDecisions> decisions_;
  std::vector<ImagePlanes> keys_;  // refined, as references() names them; none: as they are
};

// Appends the tile records of one plane to the index.
void add_records(IndexWriter& index, PlaneCode& code, uint64_t tiles) {
  code.record_sizes.resize(static_cast<size_t>(tiles), 0);
  size_t at = 0;
  for (const uint32_t size : code.record_sizes) {
    index.add(std::span(code.records).subspan(at, size));
    at += size;
  }
  code = {};
}

}  // namespace

LevelImages::LevelImages(const LightField& light_field, const StreamHeader& header,
                         const Geometry& geometry, const RkvTree& tree, int level,
                         const std::vector<ImagePos>* sample)
    : light_field_(light_field), header_(header), geometry_(geometry), tree_(tree), level_(level) {
  if (sample != nullptr && level == 0) {
    predictive_ = *sample;
    for (const ImagePos at : predictive_) {
      for (const ImagePos place : reference_images(geometry, level, at)) {
        const auto found = std::find(references_.begin(), references_.end(), place);
        if (found == references_.end()) references_.push_back(place);
      }
    }
    return;
  }
  for (uint32_t r = 0; r < shape().rows; ++r) {
    for (uint32_t c = 0; c < shape().cols; ++c) {
      (geometry.is_reference(level, {r, c}) ? references_ : predictive_).push_back({r, c});
    }
  }
}

std::vector<ImagePos> LevelImages::members(ImagePos reference) const {
  std::vector<ImagePos> members;
  for (uint32_t r = 0; r < shape().rows; ++r) {
    for (uint32_t c = 0; c < shape().cols; ++c) {
      const ImagePos at{r, c};
      if (at != reference && geometry_.reference_of(level_, at) == reference) members.push_back(at);
    }
  }
  return members;
}

ImagePlanes LevelImages::original(ImagePos at) const {
  if (level_ == 0) return view_planes(light_field_, geometry_, at);
  return tree_.at(geometry_, level_, at);
}

const SamplePlane* LevelImages::parent(ImagePos at, Plane plane) const {
  if (level_ == geometry_.top()) return nullptr;
  const ImagePos above = geometry_.ancestor(at, level_, level_ + 1);
  return &tree_.at(geometry_, level_ + 1, above)[static_cast<size_t>(plane)];
}

EncodeSession::EncodeSession(const LightField& light_field, const StreamHeader& header,
                             const LightFieldProbe& probe)
    : light_field_(light_field), header_(header), probe_(probe), geometry_(header) {
  if (header.has(Feature::kSharedDisparity)) header_.row_scale = probe.row_scale;
  originals_ = build_rkv_tree(light_field, geometry_, header.cluster_rows, header.cluster_cols);
  lossless_keys_.codestreams.resize(static_cast<size_t>(geometry_.key_count()) * kPlaneCount);
  lossless_keys_.crcs.resize(lossless_keys_.codestreams.size());
}

CodedImages EncodeSession::encode(const EncodeParams& params, bool last,
                                  const EncodeObserver& observer,
                                  const std::vector<ImagePos>* sample) {
  const auto strategy = params.profile == Profile::kMain
                            ? main_decisions(params)
                            : extended_decisions(header_, params, probe_);
  CodedImages coded;
  coded.codes.resize(static_cast<size_t>(geometry_.image_count()));
  coded.keys = lossless_keys_;
  RkvTree tree = last ? std::move(originals_) : originals_;
  Walk walk{light_field_, header_, geometry_, *strategy, observer, tree, coded, sample, {}};
  for (int level = geometry_.top(); level >= 0; --level) {
    LevelWalk(walk, level).run();
    // The level above has served as parent for the last time.
    if (level < geometry_.top()) tree.levels[static_cast<size_t>(level)].clear();
  }
  const bool lossless = std::all_of(kPlanes.begin(), kPlanes.end(),
                                    [&](Plane plane) { return strategy->key_error(plane) == 0; });
  if (lossless && !last) lossless_keys_ = coded.keys;
  return coded;
}

std::vector<uint8_t> EncodeSession::stream(CodedImages& images) const {
  IndexWriter index;
  for (ImageCode& image : images.codes) {
    for (const Plane plane : kPlanes) {
      add_records(index, image[static_cast<size_t>(plane)], geometry_.plane(plane).tiles());
    }
    if (!geometry_.motion_planes().empty()) {
      add_records(index, image[kMotionPlane], geometry_.motion_planes()[0].tiles());
    }
  }
  index.finish();
  return assemble_stream(header_, top_section(images.keys.codestreams, images.keys.crcs), index);
}

}  // namespace hmlfc
