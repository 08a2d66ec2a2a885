#include "dut/expectation.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "dut/device_file.hpp"

namespace hmlfc::lockstep {
namespace {

constexpr int kBadRequest = static_cast<int>(ErrorCode::kBadRequest);

Inside inside_of(PlaneSize plane, uint32_t bx, uint32_t by, unsigned side) {
  return {std::min(side, plane.width - bx * side), std::min(side, plane.height - by * side)};
}

// The records of the levels of a block.
class Records final : public TraceSink {
 public:
  void on_field(const FieldRecord&) override {}

  void on_stage(const StageRecord& stage) override {
    const auto found = std::ranges::find(kStageNames, stage.stage);
    if (found == kStageNames.end()) return;
    next_.site = stage.site;
    next_.stages[static_cast<size_t>(found - kStageNames.begin())] = {
        stage.clause, {stage.values.begin(), stage.values.end()}};
    if (stage.stage == "sample") done.push_back(std::exchange(next_, {}));
  }

  std::vector<ExpectedRecord> done;

 private:
  ExpectedRecord next_;
};

}  // namespace

std::string to_string(const BlockSite& site) {
  return fmt::format("level {} image {},{} plane {} block {},{}", site.level, site.image_row,
                     site.image_col, plane_name(site.plane), site.bx, site.by);
}

io::IoResult<std::unique_ptr<Model>> Model::open(const std::string& path, bool checks_sections) {
  auto file = io::map_file(path);
  if (!file) return tl::unexpected(file.error());
  auto decoder = Decoder::open(file->bytes(), {.check_sections = checks_sections});
  auto model = std::make_unique<Model>();
  model->file_.emplace(std::move(*file));
  if (decoder) {
    model->decoder_ = std::move(*decoder);
  } else {
    model->status_ = static_cast<int>(decoder.error().code);
  }
  return model;
}

// The blocks of planes that the answer is made of (COL-3).
std::vector<BlockAddress> Model::blocks(const Request& r) const {
  const ViewPos view{static_cast<uint32_t>(r.row), static_cast<uint32_t>(r.col)};
  const auto bx = static_cast<uint32_t>(r.block_x);
  const auto by = static_cast<uint32_t>(r.block_y);
  if (r.plane != kRgb) return {{view, static_cast<Plane>(r.plane), bx, by}};
  const unsigned shift = header().chroma_format == ChromaFormat::k420 ? 1 : 0;
  return {{view, Plane::kY, bx, by},
          {view, Plane::kCo, bx >> shift, by >> shift},
          {view, Plane::kCg, bx >> shift, by >> shift}};
}

Expectation Model::plane_block(const Request& request, const BlockAddress& block,
                               bool records) const {
  Expectation expected;
  Records sink;
  const auto samples = decoder_->decode_block(
      block, {.stop_level = request.stop_level, .trace = records ? &sink : nullptr});
  if (samples) {
    expected.samples = *samples;
  } else {
    expected.status = static_cast<int>(samples.error().code);
    if (expected.status == kBadRequest) return expected;
    BlockSite site;
    site.plane = block.plane;
    site.bx = block.bx;
    site.by = block.by;
    expected.failed.push_back({site, expected.status});
  }
  expected.inside =
      inside_of(decoder_->plane_size(block.plane), block.bx, block.by, header().block_size());
  expected.records = std::move(sink.done);
  for (ExpectedRecord& record : expected.records) record.inside = expected.inside;
  return expected;
}

Expectation Model::expect(const Request& request, bool records) const {
  Expectation expected;
  expected.status = status_;
  if (status_ != 0) return expected;
  const auto addresses = blocks(request);
  expected = plane_block(request, addresses.front(), records);
  if (expected.status == kBadRequest) return expected;
  for (size_t i = 1; i < addresses.size(); ++i) {
    Expectation more = plane_block(request, addresses[i], records);
    if (expected.status == 0) expected.status = more.status;
    std::ranges::move(more.records, std::back_inserter(expected.records));
    std::ranges::move(more.failed, std::back_inserter(expected.failed));
  }
  if (expected.status != 0) {
    expected.samples.clear();
  } else if (request.plane == kRgb) {
    fill_rgb(request, expected);
  }
  return expected;
}

// COL-2: the pixels of the block; positions outside the view are 0.
void Model::fill_rgb(const Request& r, Expectation& expected) const {
  const unsigned side = header().block_size();
  const Rect rect{static_cast<uint32_t>(r.block_x) * side, static_cast<uint32_t>(r.block_y) * side,
                  expected.inside.x, expected.inside.y};
  const auto image = decoder_->decode_rgb(
      {static_cast<uint32_t>(r.row), static_cast<uint32_t>(r.col)}, rect, r.stop_level);
  expected.samples.assign(kLanes * side * side, 0);
  if (!image) {
    expected.status = static_cast<int>(image.error().code);
    return;
  }
  for (unsigned y = 0; y < rect.height; ++y) {
    for (unsigned x = 0; x < rect.width; ++x) {
      for (size_t lane = 0; lane < kLanes; ++lane) {
        expected.samples[(lane * side + y) * side + x] =
            image->samples[(size_t{y} * rect.width + x) * kLanes + lane];
      }
    }
  }
}

}  // namespace hmlfc::lockstep
