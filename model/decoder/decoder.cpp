#include <hmlfc/decoder.hpp>

#include <algorithm>

#include "arithmetic/rounding.hpp"
#include "decoder/colour_row.hpp"
#include "decoder/decoder_state.hpp"
#include "decoder/fast/region_decoder.hpp"
#include "decoder/golden/block_decoder.hpp"
#include "decoder/open_stream.hpp"
#include "decoder/request_guard.hpp"

namespace hmlfc {
namespace {

tl::unexpected<Error> bad_request() { return fail(ErrorCode::kBadRequest, Section::kHeader, 0); }

bool has_view(const StreamHeader& header, ViewPos view, int stop_level) {
  return view.row < header.rows && view.col < header.cols && stop_level >= 0 &&
         stop_level <= header.tree_height;
}

bool contains(uint32_t width, uint32_t height, const Rect& rect) {
  return rect.width > 0 && rect.height > 0 && rect.x < width && rect.y < height &&
         rect.width <= width - rect.x && rect.height <= height - rect.y;
}

// The blocks that `rect` touches.
BlockRect blocks_of(const Rect& rect, uint32_t block_size) {
  return {rect.x / block_size, rect.y / block_size, ceil_div(rect.x + rect.width, block_size),
          ceil_div(rect.y + rect.height, block_size)};
}

// The part `rect` of a region that begins with block (blocks.bx0, blocks.by0).
SamplePlane crop(const SamplePlane& region, const BlockRect& blocks, const Rect& rect,
                 uint32_t block_size) {
  SamplePlane samples(rect.width, rect.height);
  copy_samples(region, rect.x - blocks.bx0 * block_size, rect.y - blocks.by0 * block_size,
               rect.width, rect.height, samples);
  return samples;
}

// Whether `rect` begins at a corner of a block and ends at one or at the plane's border.
bool has_whole_blocks(const PlaneShape& shape, const Rect& rect, uint32_t block_size) {
  const auto ends = [&](uint32_t end, uint32_t border) {
    return end % block_size == 0 || end == border;
  };
  return rect.x % block_size == 0 && rect.y % block_size == 0 &&
         ends(rect.x + rect.width, shape.width) && ends(rect.y + rect.height, shape.height);
}

// Whether `region` is `rect`, or, unless `exactly`, begins with it and goes on to the right and
// below.
bool is_cropped(const SamplePlane& region, const BlockRect& blocks, const Rect& rect,
                uint32_t block_size, bool exactly) {
  return rect.x == blocks.bx0 * block_size && rect.y == blocks.by0 * block_size &&
         (!exactly || (region.width == rect.width && region.height == rect.height));
}

// The samples of `rect`, which lies in the plane of `image` and in those after it that are decoded
// together: planes of its size, or, unless `exactly`, ones that begin with them.
Result<void> decode_samples(const FastSources& fast, const DecodeSources& golden,
                            const BlockSite& image, const Rect& rect, bool exactly,
                            std::span<SamplePlane> samples) {
  const uint32_t block_size = fast.stream.geometry.block_size();
  const BlockRect blocks = blocks_of(rect, block_size);
  const ImagePos at{image.image_row, image.image_col};
  const auto decoded = decode_region(fast, image.level, at, image.plane, blocks, samples);
  if (!decoded && fast.requests != nullptr) return decoded;
  for (size_t p = 0; p < samples.size(); ++p) {
    if (!decoded) {
      // The golden path finds which block fails, and whether it is one of those asked for.
      const auto plane = static_cast<Plane>(static_cast<size_t>(image.plane) + p);
      auto region = decode_region_by_blocks(golden, image.level, at, plane, blocks);
      if (!region) return tl::unexpected(region.error());
      samples[p] = std::move(*region);
    }
    if (!is_cropped(samples[p], blocks, rect, block_size, exactly)) {
      samples[p] = crop(samples[p], blocks, rect, block_size);
    }
  }
  return {};
}

}  // namespace

Decoder::Decoder(std::unique_ptr<State> state) : state_(std::move(state)) {}
Decoder::Decoder(Decoder&&) noexcept = default;
Decoder& Decoder::operator=(Decoder&&) noexcept = default;
Decoder::~Decoder() = default;

Result<Decoder> Decoder::open(std::span<const uint8_t> file, const OpenOptions& options) {
  MemorySource source(file);
  return open(source, options);
}

Result<Decoder> Decoder::open(ByteSource& source, const OpenOptions& options) {
  return guard_request(source.is_partial() ? &source : nullptr, [&]() -> Result<Decoder> {
    auto stream = open_stream(source, options);
    if (!stream) return tl::unexpected(stream.error());
    return Decoder(std::make_unique<State>(std::move(*stream)));
  });
}

const StreamHeader& Decoder::header() const { return state_->stream.header; }

PlaneSize Decoder::plane_size(Plane plane) const {
  const PlaneShape& shape = state_->stream.geometry.plane(plane);
  return {shape.width, shape.height};
}

Result<std::vector<int32_t>> Decoder::decode_block(const BlockAddress& block,
                                                   const BlockOptions& options) const {
  const int stop_level = options.stop_level;
  const Geometry& geometry = state_->stream.geometry;
  const PlaneShape& plane = geometry.plane(block.plane);
  if (!has_view(header(), block.view, stop_level) || block.bx >= plane.blocks_x ||
      block.by >= plane.blocks_y) {
    return bad_request();
  }
  const ImagePos image = geometry.ancestor({block.view.row, block.view.col}, 0, stop_level);
  const BlockSite site{stop_level, image.row, image.col, block.plane, block.bx, block.by};
  const DecodeSources sources =
      options.references == ReferenceMode::kSparse ? state_->golden_held() : state_->golden();
  return guard_request(state_->stream.source, [&]() -> Result<std::vector<int32_t>> {
    const ImagePart part{
        stop_level, image, block.plane, {block.bx, block.by, block.bx + 1, block.by + 1}};
    state_->load({&part, 1});
    const auto values =
        hmlfc::decode_block(sources, site, Probe{options.trace, options.counts, site});
    if (!values) return tl::unexpected(values.error());
    return std::vector<int32_t>(values->span().begin(), values->span().end());
  });
}

Result<std::vector<int16_t>> Decoder::decode_rect(ViewPos view, Plane plane, const Rect& rect,
                                                  int stop_level) const {
  const HeldBytes held(state_->stream.source);
  const PlaneSize size = plane_size(plane);
  if (has_view(header(), view, stop_level) && contains(size.width, size.height, rect)) {
    const Geometry& geometry = state_->stream.geometry;
    const ImagePart part{stop_level, geometry.ancestor({view.row, view.col}, 0, stop_level), plane,
                         blocks_of(rect, geometry.block_size())};
    state_->load({&part, 1});
  }
  return DecoderAccess::decode_rect(*this, view, plane, rect, stop_level, nullptr);
}

Result<void> Decoder::refine_rect(ViewPos view, Plane plane, const Rect& rect, int stop_level,
                                  std::span<int16_t> samples) const {
  const Geometry& geometry = state_->stream.geometry;
  const PlaneShape& shape = geometry.plane(plane);
  const uint32_t block_size = geometry.block_size();
  if (!has_view(header(), view, stop_level + 1) || stop_level < 0 ||
      !contains(shape.width, shape.height, rect) || !has_whole_blocks(shape, rect, block_size) ||
      samples.size() != size_t{rect.width} * rect.height) {
    return bad_request();
  }
  const ImagePos image = geometry.ancestor({view.row, view.col}, 0, stop_level);
  return guard_request(state_->stream.source, [&]() -> Result<void> {
    const BlockRect blocks = blocks_of(rect, block_size);
    SamplePlane region((blocks.bx1 - blocks.bx0) * block_size,
                       (blocks.by1 - blocks.by0) * block_size);
    for (uint32_t j = 0; j < rect.height; ++j) {
      const auto row = samples.subspan(size_t{j} * rect.width, rect.width);
      std::ranges::copy(row, region.row(j).begin());
    }
    if (auto ok = add_level(state_->fast(), stop_level, image, plane, blocks, {&region, 1}); !ok) {
      return ok;
    }
    for (uint32_t j = 0; j < rect.height; ++j) {
      const auto row = samples.subspan(size_t{j} * rect.width, rect.width);
      std::copy_n(region.row(j).begin(), rect.width, row.begin());
    }
    return {};
  });
}

Result<std::vector<int16_t>> Decoder::decode_plane(ViewPos view, Plane plane,
                                                   int stop_level) const {
  const PlaneSize size = plane_size(plane);
  return decode_rect(view, plane, {0, 0, size.width, size.height}, stop_level);
}

Result<RgbImage> Decoder::decode_rgb(ViewPos view, const Rect& rect, int stop_level) const {
  if (!has_view(header(), view, stop_level) || !contains(header().width, header().height, rect)) {
    return bad_request();
  }
  const bool halved = header().chroma_format == ChromaFormat::k420;
  const uint32_t block_size = state_->stream.geometry.block_size();
  const ImagePos image = state_->stream.geometry.ancestor({view.row, view.col}, 0, stop_level);
  return guard_request(state_->stream.source, [&]() -> Result<RgbImage> {
    std::vector<ImagePart> parts;
    for (const Plane plane : kPlanes) {
      parts.push_back({stop_level, image, plane,
                       blocks_of(chroma_rect(rect, halved && plane != Plane::kY), block_size)});
    }
    state_->load(parts);
    std::array<SamplePlane, kPlaneCount> planes;
    for (const PlaneGroup& group : kPlaneGroups) {
      const auto ok = decode_samples(
          state_->fast(), state_->golden(), {stop_level, image.row, image.col, group.first},
          chroma_rect(rect, halved && group.first != Plane::kY), false, group.of(planes));
      if (!ok) return tl::unexpected(ok.error());
    }
    return rgb_picture(planes, rect, halved, header().depth);
  });
}

Result<RgbImage> Decoder::decode_view(ViewPos view, int stop_level) const {
  return decode_rgb(view, {0, 0, header().width, header().height}, stop_level);
}

const StreamView& DecoderAccess::stream(const Decoder& decoder) { return decoder.state_->stream; }

Result<std::vector<int16_t>> DecoderAccess::decode_rect(const Decoder& decoder, ViewPos view,
                                                        Plane plane, const Rect& rect,
                                                        int stop_level, KeyRequests* requests) {
  const Decoder::State& state = *decoder.state_;
  const Geometry& geometry = state.stream.geometry;
  const PlaneShape& shape = geometry.plane(plane);
  if (!has_view(state.stream.header, view, stop_level) ||
      !contains(shape.width, shape.height, rect)) {
    return bad_request();
  }
  const ImagePos image = geometry.ancestor({view.row, view.col}, 0, stop_level);
  return guard_request(state.stream.source, [&]() -> Result<std::vector<int16_t>> {
    SamplePlane samples;
    const auto ok =
        decode_samples(state.fast(requests), state.golden(),
                       {stop_level, image.row, image.col, plane}, rect, true, {&samples, 1});
    if (!ok) return tl::unexpected(ok.error());
    return std::move(samples.samples);
  });
}

void DecoderAccess::load(const Decoder& decoder, std::span<const ImagePart> parts) {
  decoder.state_->load(parts);
}

void DecoderAccess::decode_keys(const Decoder& decoder, std::span<const KeyRequests> requests) {
  decoder.state_->keys.decode(requests);
}

size_t Decoder::reference_bytes() const { return state_->references.bytes(); }

}  // namespace hmlfc
