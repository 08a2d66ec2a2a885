#include "oracle/oracle.hpp"

#include <algorithm>

#include "arithmetic/colour.hpp"
#include "decoder/golden/block_walk.hpp"

namespace hmlfc::tb {
namespace {

// Fills the records of a chain of levels, which begins with `levels[0]`.
class StageCollector final : public TraceSink {
 public:
  explicit StageCollector(std::vector<LevelRecord>& levels) : levels_(levels) {}

  void on_field(const FieldRecord&) override {}

  void on_stage(const StageRecord& stage) override {
    LevelRecord& level = levels_[done_];
    switch (stage.stage[0]) {
      case 'r':
        if (stage.stage == "residual") {
          level.has_residual = true;
          copy(stage, level.residual);
        } else {
          level.motion = true;
          copy(stage, level.reference);
        }
        break;
      case 's':
        copy(stage, level.sample);
        ++done_;
        break;
      default:
        if (stage.stage == "prediction") copy(stage, level.prediction);
    }
  }

  size_t done() const { return done_; }

 private:
  static void copy(const StageRecord& stage, StageValues& out) {
    std::transform(stage.values.begin(), stage.values.end(), out.begin(),
                   [](int32_t value) { return static_cast<int16_t>(value); });
  }

  std::vector<LevelRecord>& levels_;
  size_t done_ = 0;
};

}  // namespace

bool request_exists(const GoldenStream& stream, const Request& request) {
  const StreamHeader& header = stream.header();
  const Plane plane = request.plane == kRgb ? Plane::kY : static_cast<Plane>(request.plane);
  const Geometry& geometry = stream.geometry();
  const PlaneShape& shape = geometry.plane(plane);
  const int stop = static_cast<int>(request.stop_level);
  const bool there = request.row < header.rows && request.col < header.cols &&
                     stop <= header.tree_height && request.bx < shape.blocks_x &&
                     request.by < shape.blocks_y;
  if (!there || !request.residuals) return there;
  const ImagePos image = geometry.ancestor({request.row, request.col}, 0, stop);
  return request.plane != kRgb && !geometry.level(stop).keyed && geometry.is_reference(stop, image);
}

ExpectedAnswer Oracle::evaluate(const Request& request) {
  ExpectedAnswer expected;
  expected.request = request;
  expected.answer.last = request.last;
  if (load_error_ != 0 || !request_exists(*stream_, request)) {
    expected.answer.status =
        load_error_ != 0 ? load_error_ : static_cast<uint8_t>(ErrorCode::kBadRequest);
    return expected;
  }
  const Plane first = request.plane == kRgb ? Plane::kY : static_cast<Plane>(request.plane);
  const PlaneShape& shape = stream_->geometry().plane(first);
  const unsigned size = stream_->geometry().block_size();
  expected.inside_x = inside(shape.width, request.bx, size);
  expected.inside_y = inside(shape.height, request.by, size);
  expected.planes[0] = plane_block(request, first, request.bx, request.by);
  if (request.plane == kRgb) {
    const ChromaFormat format = stream_->header().chroma_format;
    for (const Plane plane : {Plane::kCo, Plane::kCg}) {
      expected.planes[static_cast<size_t>(plane)] = plane_block(
          request, plane, chroma_block(request.bx, format), chroma_block(request.by, format));
    }
  }
  for (const PlanePointer& plane : expected.planes) {
    if (plane && expected.answer.status == 0) expected.answer.status = plane->status;
  }
  if (expected.answer.status != 0) return expected;
  if (request.plane == kRgb) {
    fill_rgb(expected);
  } else {
    const LevelRecord& level = expected.planes[0]->levels.back();
    const StageValues& samples = request.residuals ? level.residual : level.sample;
    std::copy_n(samples.begin(), size * size, expected.answer.samples.begin());
  }
  return expected;
}

Oracle::PlanePointer Oracle::plane_block(const Request& request, Plane plane, uint32_t bx,
                                         uint32_t by) {
  Request own = request;
  own.plane = static_cast<unsigned>(plane);
  own.bx = bx;
  own.by = by;
  const uint64_t key = own.word();
  CacheLine& line = cache_[(key * 0x9e3779b97f4a7c15u) >> 54];
  if (line.key != key || !line.plane) {
    const int stop = static_cast<int>(request.stop_level);
    const ImagePos image = stream_->geometry().ancestor({request.row, request.col}, 0, stop);
    const BlockSite site{stop, image.row, image.col, plane, bx, by};
    line = {key, request.residuals ? residuals(site) : decode(site)};
  }
  return line.plane;
}

Oracle::PlanePointer Oracle::decode(const BlockSite& site) const {
  const Geometry& geometry = stream_->geometry();
  auto plane = std::make_shared<ExpectedPlane>();
  const ImagePos own{site.image_row, site.image_col};
  for (int l = first_level(geometry, site.level, own); l >= site.level; --l) {
    const ImagePos image = geometry.ancestor(own, site.level, l);
    LevelRecord& level = plane->levels.emplace_back();
    level.site = site;
    level.site.level = l;
    level.site.image_row = image.row;
    level.site.image_col = image.col;
    level.key = geometry.is_key(l, image);
  }
  StageCollector collector(plane->levels);
  const DecodeSources sources{stream_->view(), stream_->keys(), held_};
  const auto block = decode_block(sources, site, Probe{&collector, nullptr, site});
  if (!block) {
    plane->status = static_cast<uint8_t>(block.error().code);
    plane->levels[collector.done()].error = plane->status;
  }
  for (size_t i = 0; i < collector.done(); ++i) {
    if (plane->levels[i].motion) add_motion(plane->levels[i]);
  }
  return plane;
}

// The residuals alone (DEC-4): a block without parent and motion.
Oracle::PlanePointer Oracle::residuals(const BlockSite& site) const {
  auto plane = std::make_shared<ExpectedPlane>();
  LevelRecord& level = plane->levels.emplace_back();
  level.site = site;
  const auto block = walk_to_block(stream_->view(), Probe{nullptr, nullptr, site});
  if (!block) {
    plane->status = level.error = static_cast<uint8_t>(block.error().code);
    return plane;
  }
  level.has_residual = block->entry.has_residual();
  const SampleRange range = sample_range(site.plane, stream_->header().depth);
  const auto values = block->residual.span();
  for (size_t i = 0; i < values.size(); ++i) {
    level.residual[i] = static_cast<int16_t>(values[i]);
    level.sample[i] = static_cast<int16_t>(clamp(values[i], range.lo, range.hi));
  }
  return plane;
}

// The vectors of a block that has decoded.
void Oracle::add_motion(LevelRecord& record) const {
  const Probe probe{nullptr, nullptr, record.site};
  if (stream_->header().has(Feature::kMotionTiles)) {
    const auto motion = walk_to_motion(stream_->view(), probe);
    record.references = motion->count;
    record.negative = motion->negative;
    for (unsigned i = 0; i < motion->count; ++i) record.vectors[i] = motion->references[i].vector;
  } else {
    const auto block = walk_to_block(stream_->view(), probe);
    record.references = 1;
    record.negative = block->entry.negative;
    record.vectors[0] = {block->entry.dx, block->entry.dy, 0, 0};
  }
}

// COL-2, COL-3.
void Oracle::fill_rgb(ExpectedAnswer& expected) const {
  const unsigned size = stream_->geometry().block_size();
  const bool halved = stream_->header().chroma_format == ChromaFormat::k420;
  const unsigned shift = halved ? 1 : 0;
  const unsigned x0 = halved ? (expected.request.bx & 1) * size / 2 : 0;
  const unsigned y0 = halved ? (expected.request.by & 1) * size / 2 : 0;
  const auto& y_samples = expected.planes[0]->levels.back().sample;
  const auto& co = expected.planes[1]->levels.back().sample;
  const auto& cg = expected.planes[2]->levels.back().sample;
  for (unsigned y = 0; y < size; ++y) {
    for (unsigned x = 0; x < size; ++x) {
      const size_t i = size_t{y} * size + x;
      const size_t c = size_t{y0 + (y >> shift)} * size + x0 + (x >> shift);
      const Rgb pixel = inverse_colour({y_samples[i], co[c], cg[c]}, stream_->header().depth);
      const size_t lane = size_t{size} * size;
      expected.answer.samples[i] = static_cast<int16_t>(pixel.r);
      expected.answer.samples[lane + i] = static_cast<int16_t>(pixel.g);
      expected.answer.samples[2 * lane + i] = static_cast<int16_t>(pixel.b);
    }
  }
}

}  // namespace hmlfc::tb
