#include "conform/minimise.hpp"

#include <algorithm>
#include <optional>

#include "conform/stream_parts.hpp"
#include "decoder/jpeg2000.hpp"
#include "decoder/open_stream.hpp"
#include "syntax/header.hpp"

namespace hmlfc::conform {

namespace {

SamplePlane cropped(const SamplePlane& plane, const PlaneShape& shape) {
  SamplePlane cut(shape.width, shape.height);
  for (uint32_t y = 0; y < cut.height; ++y) {
    std::ranges::copy(plane.row(y).first(cut.width), cut.row(y).begin());
  }
  return cut;
}

bool decodes(std::span<const uint8_t> stream) {
  const auto decoder = Decoder::open(stream);
  return decoder && decoder->decode_all([](ViewPos, RgbImage&&) {}, {.threads = 1});
}

// The upper left pixels of all views, as many as `header` has; key images are cropped and coded
// anew. Nothing if a key image does not decode.
std::optional<StreamParts> with_size(const StreamParts& parts, const StreamHeader& header) {
  StreamParts smaller = parts;
  smaller.header = header;
  if (!check_fields(smaller.header)) return std::nullopt;
  const Geometry before(parts.header);
  const Geometry after(smaller.header);
  for (auto& [place, key] : smaller.keys) {
    const auto plane = static_cast<Plane>(place.plane);
    const PlaneShape& shape = before.plane(plane);
    if (!has_key_image_head(key.codestream, shape.width, shape.height,
                            key_precision(parts.header, place.plane))) {
      return std::nullopt;
    }
    const auto samples = decode_jpeg2000(key.codestream, shape.width, shape.height);
    if (!samples) return std::nullopt;
    auto code = key_code(cropped(*samples, after.plane(plane)), parts.header, place.plane);
    if (!code) return std::nullopt;
    key = std::move(*code);
  }
  return smaller;
}

// Of another header: images that become key images get the samples that `decoder`, opened on the
// stream of `parts`, gives for them. Nothing if one does not decode.
std::optional<StreamParts> with_keys(const StreamParts& parts, const StreamHeader& header,
                                     const Decoder& decoder) {
  StreamParts smaller = parts;
  smaller.header = header;
  if (!add_missing_keys(smaller, decoder)) return std::nullopt;
  return smaller;
}

// Without the top level: the reference images of the level below become key images. Nothing if the
// tree has one level, or an image does not decode.
std::optional<StreamParts> without_top_level(const StreamParts& parts, const Decoder& decoder) {
  StreamHeader header = parts.header;
  if (header.tree_height == 0) return std::nullopt;
  --header.tree_height;
  header.levels.pop_back();
  return with_keys(parts, header, decoder);
}

// Without tile records `begin` to `end` - 1.
StreamParts without_tiles(const StreamParts& parts, size_t begin, size_t end) {
  StreamParts smaller{parts.header, parts.keys, {}, parts.rig};
  size_t number = 0;
  for (const auto& tile : parts.tiles) {
    if (number < begin || number >= end) smaller.tiles.insert(tile);
    ++number;
  }
  return smaller;
}

// Without section RIG.
StreamParts without_rig(const StreamParts& parts) {
  StreamParts smaller = parts;
  smaller.header.feature_flags &= ~feature_bit(Feature::kCameraRig);
  smaller.rig.clear();
  return smaller;
}

// One search, which starts from a failing stream.
class Search {
 public:
  Search(StreamParts parts, std::vector<uint8_t> stream, const StillFails& still_fails,
         unsigned max_trials)
      : parts_(std::move(parts)), still_fails_(still_fails), max_trials_(max_trials) {
    result_.stream = std::move(stream);
  }

  Minimised run() {
    unsigned before = 0;
    do {
      before = result_.steps;
      while (cut_top()) {
      }
      shrink(&StreamHeader::rows, 1);
      shrink(&StreamHeader::cols, 1);
      shrink(&StreamHeader::width, parts_.header.block_size());
      shrink(&StreamHeader::height, parts_.header.block_size());
      drop_tiles();
      if (parts_.header.has(Feature::kCameraRig)) keep_if_failing(without_rig(parts_));
    } while (result_.steps != before && result_.trials < max_trials_);
    return std::move(result_);
  }

 private:
  // Keeps `smaller` if it is a valid stream that still fails.
  bool keep_if_failing(const std::optional<StreamParts>& smaller) {
    if (!smaller || result_.trials >= max_trials_) return false;
    auto stream = put_together(*smaller);
    if (!stream || !decodes(*stream)) return false;
    ++result_.trials;
    if (!still_fails_(*stream)) return false;
    // The new stream lacks the parts that its header has no place for.
    const auto view = open_stream(*stream, {});
    auto parts = view ? take_apart(*view) : std::nullopt;
    if (!parts) return false;
    parts_ = std::move(*parts);
    result_.stream = std::move(*stream);
    ++result_.steps;
    return true;
  }

  bool cut_top() {
    if (parts_.header.tree_height == 0) return false;
    const auto decoder = Decoder::open(result_.stream);
    return decoder && keep_if_failing(without_top_level(parts_, *decoder));
  }

  // Reduces one side of the grid or of the views: first to the minimum, then by ever smaller
  // steps, all multiples of `unit`.
  void shrink(uint32_t StreamHeader::*side, uint32_t unit) {
    for (uint32_t step = parts_.header.*side / unit * unit; step >= unit;) {
      const uint32_t now = parts_.header.*side;
      const uint32_t target = now > step ? (now - step + unit - 1) / unit * unit : unit;
      if (target < now && keep_if_failing(with(side, target))) continue;
      step = step / 2 / unit * unit;
    }
  }

  std::optional<StreamParts> with(uint32_t StreamHeader::*side, uint32_t value) const {
    StreamHeader header = parts_.header;
    header.*side = value;
    if (header.rows != parts_.header.rows || header.cols != parts_.header.cols) {
      const auto decoder = Decoder::open(result_.stream);
      if (!decoder) return std::nullopt;
      return with_keys(parts_, header, *decoder);
    }
    return with_size(parts_, header);
  }

  // Drops halves, quarters ... down to single tiles.
  void drop_tiles() {
    for (size_t chunk = parts_.tiles.size(); chunk >= 1; chunk /= 2) {
      for (size_t begin = 0; begin < parts_.tiles.size();) {
        if (!keep_if_failing(without_tiles(parts_, begin, begin + chunk))) begin += chunk;
      }
    }
  }

  StreamParts parts_;
  const StillFails& still_fails_;
  unsigned max_trials_;
  Minimised result_;
};

}  // namespace

io::IoResult<Minimised> minimise(std::span<const uint8_t> stream, const StillFails& still_fails,
                                 unsigned max_trials) {
  const auto view = open_stream(stream, {});
  if (!view || !decodes(stream)) {
    return tl::unexpected(io::IoError{"the golden model does not decode the stream"});
  }
  auto parts = take_apart(*view);
  if (!parts) return tl::unexpected(io::IoError{"the stream has too many tiles"});
  return Search(std::move(*parts), {stream.begin(), stream.end()}, still_fails, max_trials).run();
}

}  // namespace hmlfc::conform
