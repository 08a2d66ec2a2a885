#include "encoder/encode_session.hpp"

#include <mutex>
#include <new>
#include <span>
#include <utility>

#include "arithmetic/widths.hpp"
#include "bits/parallel.hpp"
#include "decoder/jpeg2000.hpp"
#include "decoder/key_images.hpp"
#include "encoder/key_curve.hpp"
#include "encoder/stream_writer.hpp"

namespace hmlfc {
namespace {

// Everything that the levels of one encoding share.
struct Walk {
  const ViewProvider& views;
  const StreamHeader& header;
  const Geometry& geometry;
  const DecisionStrategy& strategy;
  const EncodeObserver& observer;
  RkvTree& tree;
  CodedImages& coded;
  const EncodePart& part;
  QualityTrim* trim;
  std::mutex error_mutex;
};

// Codes one level. Above level 0 the tree's images of the level become the reconstructed ones.
class LevelWalk {
 public:
  LevelWalk(Walk& walk, int level)
      : walk_(walk),
        geometry_(walk.geometry),
        images_(walk.views, walk.header, walk.geometry, walk.tree, level, walk.part),
        decisions_(walk.strategy.begin_level(images_)) {}

  // False: a trim lets all begin again.
  bool run() {
    const LevelPart& part = images_.part();
    if (images_.shape().keyed && part.predicts) refine_keys();
    std::vector<uint64_t> squares(part.references.size());
    parallel_for(squares.size(), [&](size_t i) { squares[i] = encode_reference(i); });
    for (const ImagePos at : part.groups) {
      PlaneCode records = decisions_->decide_group(at);
      if (owned(at)) walk_.coded.records.open(number(at))[kMotionPlane] = std::move(records);
    }
    if (walk_.trim == nullptr || images_.level() > 0) {
      encode_predictive(part.predictive);
    } else if (!encode_trimmed(*walk_.trim, squares)) {
      return false;
    }
    for (const ImagePos at : part.references) {
      if (owned(at)) walk_.coded.records.close(number(at));
    }
    return true;
  }

 private:
  size_t number(ImagePos at) const {
    return static_cast<size_t>(geometry_.image_number(images_.level(), at));
  }

  // Whether the code of image `at` is the part's own, and not coded to refer to it alone.
  bool owned(ImagePos at) const {
    return !walk_.part.views || owns(*walk_.part.views, geometry_, images_.level(), at);
  }

  // False: all begins again. `of_references`: squared errors.
  bool encode_trimmed(QualityTrim& trim, std::span<const uint64_t> of_references) {
    if (!trim.go_on(of_references)) return false;
    for (const auto& round : QualityTrim::rounds(geometry_, images_.part().predictive)) {
      decisions_->change_quality(trim.quality());
      if (!trim.go_on(encode_predictive(round))) return false;
    }
    return true;
  }

  // Returns the squared errors of views, 0 for images above them.
  std::vector<uint64_t> encode_predictive(const std::vector<ImagePos>& images) {
    std::vector<uint64_t> squares(images.size());
    parallel_for(images.size(), [&](size_t i) {
      const ImagePos at = images[i];
      squares[i] = finish(at, decisions_->encode_predictive(at, images_.original(at)));
      if (owned(at)) walk_.coded.records.close(number(at));
    });
    return squares;
  }

  void refine_keys() {
    const auto& references = images_.part().references;
    keys_.resize(references.size());
    parallel_for(keys_.size(), [&](size_t i) { keys_[i] = images_.original(references[i]); });
    decisions_->refine_keys(keys_);
  }

  // Codes the i-th of the part's references. Returns its squared errors, likewise.
  uint64_t encode_reference(size_t i) {
    const ImagePos at = images_.part().references[i];
    if (!images_.shape().keyed) {
      return finish(at, decisions_->encode_reference(at, images_.original(at)));
    }
    EncodedImage key;
    key.samples = keys_.empty() ? images_.original(at) : std::move(keys_[i]);
    parallel_for(kPlaneCount, [&](size_t p) { encode_key(at, kPlanes[p], key.samples[p]); });
    decisions_->take_key(at, key.samples);
    return finish(at, std::move(key));
  }

  // Codes one plane of a key image; `samples` become what a decoder makes of it, in whole blocks.
  void encode_key(ImagePos at, Plane plane, SamplePlane& samples) {
    const PlaneShape& shape = geometry_.plane(plane);
    const int depth = walk_.header.depth;
    const SampleRange range = sample_range(plane, depth);
    const uint64_t key = geometry_.key_number(images_.level(), at);
    const size_t entry = static_cast<size_t>(key) * kPlaneCount + static_cast<size_t>(plane);
    CodedKeys& keys = walk_.coded.keys;
    const double error = walk_.strategy.key_errors[static_cast<size_t>(plane)];
    const bool known = keys.has(entry);  // by an encoding without loss, or by a part before
    SamplePlane inside = cropped(samples, shape.width, shape.height);
    if (!known) {
      CodedPlane coded = code_key_plane(inside, precision_of(plane, depth), error);
      inside = std::move(coded.decoded);
      clamp_samples(inside, range);
      keys.set(entry, std::move(coded.codestream), sample_crc(inside));
    } else if (error > 0) {
      const auto decoded = decode_jpeg2000(keys.codestream(entry), shape.width, shape.height);
      if (!decoded) throw std::bad_alloc();
      inside = *decoded;
      clamp_samples(inside, range);
    }
    samples = in_whole_blocks(inside, shape, geometry_.block_size());
  }

  uint64_t finish(ImagePos at, EncodedImage image) {
    const int level = images_.level();
    ErrorSums error;
    if (owned(at)) walk_.coded.records.open(number(at)) = std::move(image.code);
    if (walk_.observer.reconstructed) walk_.observer.reconstructed(level, at, image.samples);
    if (level > 0) {
      walk_.tree.at(geometry_, level, at) = std::move(image.samples);
    } else if (walk_.part.views && owned(at)) {
      error = view_error(walk_.views, at, image.samples, walk_.header.chroma_format);
      const std::scoped_lock lock(walk_.error_mutex);
      walk_.coded.error.add(error);
    }
    if (walk_.observer.image_done && owned(at)) walk_.observer.image_done();
    return error.rgb_squares;
  }

  Walk& walk_;
  const Geometry& geometry_;
  LevelImages images_;
  std::unique_ptr<LevelDecisions> decisions_;
  std::vector<ImagePlanes> keys_;  // refined, of the part's references; none: as they are
};

}  // namespace

ImagePlanes LevelImages::original(ImagePos at) const {
  if (level_ == 0) return view_planes(views_, geometry_, at);
  return tree_.at(geometry_, level_, at);
}

const SamplePlane* LevelImages::parent(ImagePos at, Plane plane) const {
  if (level_ == geometry_.top()) return nullptr;
  const ImagePos above = geometry_.ancestor(at, level_, level_ + 1);
  return &tree_.at(geometry_, level_ + 1, above)[static_cast<size_t>(plane)];
}

EncodeSession::EncodeSession(const ViewProvider& views, const StreamHeader& header,
                             const LightFieldProbe& probe, CodeStorage* storage)
    : views_(views), header_(header), probe_(probe), storage_(storage), geometry_(header) {
  if (header.has(Feature::kSharedDisparity)) header_.row_scale = probe.row_scale;
  lossless_keys_ = no_images().keys;
}

CodedImages EncodeSession::no_images() const {
  const auto images = static_cast<size_t>(geometry_.image_count());
  const auto keys = static_cast<size_t>(geometry_.key_count()) * kPlaneCount;
  return {CodedRecords(images, storage_), CodedKeys(keys, storage_), {}};
}

RkvTree EncodeSession::originals(bool last) {
  if (!whole_) {
    whole_ = part_of_views(geometry_, geometry_.level(0).all_images(),
                           [](int, ImagePos) { return false; });
    originals_ = build_rkv_tree(views_, geometry_, *whole_);
  }
  return last ? std::move(originals_) : originals_;
}

std::optional<CodedImages> EncodeSession::encode(const EncodeParams& params, bool last,
                                                 const EncodeObserver& observer,
                                                 QualityTrim* trim) {
  RkvTree tree = originals(last);
  CodedImages coded = no_images();
  coded.keys = lossless_keys_;
  if (!walk(params, *whole_, tree, observer, coded, trim)) return std::nullopt;
  if (!header_.has(Feature::kLossyKeys) && !last) lossless_keys_ = coded.keys;
  return coded;
}

void EncodeSession::encode_part(const EncodeParams& params, const EncodePart& part,
                                const EncodeObserver& observer, CodedImages& coded) const {
  RkvTree tree = build_rkv_tree(views_, geometry_, part);
  walk(params, part, tree, observer, coded);
}

DecisionStrategy EncodeSession::strategy_of(const EncodeParams& params) const {
  return params.profile == Profile::kMain ? main_decisions(params)
                                          : extended_decisions(header_, params, probe_);
}

bool EncodeSession::walk(const EncodeParams& params, const EncodePart& part, RkvTree& tree,
                         const EncodeObserver& observer, CodedImages& coded,
                         QualityTrim* trim) const {
  const DecisionStrategy strategy = strategy_of(params);
  Walk walk{views_, header_, geometry_, strategy, observer, tree, coded, part, trim, {}};
  for (int level = geometry_.top(); level >= 0; --level) {
    if (!LevelWalk(walk, level).run()) return false;
    // The level above has served as parent for the last time.
    if (level < geometry_.top()) tree.levels[static_cast<size_t>(level)].clear();
  }
  return true;
}

std::vector<uint8_t> EncodeSession::stream(const CodedImages& images) const {
  std::vector<uint8_t> bytes;
  write_stream(header_, images, {}, [&](std::span<const uint8_t> more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
  });
  return bytes;
}

}  // namespace hmlfc
