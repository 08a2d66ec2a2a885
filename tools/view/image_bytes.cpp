#include "view/image_bytes.hpp"

#include <bit>

#include "decoder/key_images.hpp"
#include "decoder/open_stream.hpp"
#include "syntax/index.hpp"
#include "syntax/tile_record.hpp"

namespace hmlfc::view {

namespace {

class Counter {
 public:
  explicit Counter(const StreamView& stream) : stream_(stream) {}

  Result<ImageBytes> run() {
    for (int level = stream_.geometry.top(); level >= 0; --level) {
      const LevelShape& shape = stream_.geometry.level(level);
      LevelBytes& bytes = counted_.levels.emplace_back();
      bytes.level = level;
      bytes.rows = shape.rows;
      bytes.cols = shape.cols;
      for (uint32_t row = 0; row < shape.rows; ++row) {
        for (uint32_t col = 0; col < shape.cols; ++col) {
          bytes.images.push_back(0);
          if (auto ok = add_image(bytes, {row, col}); !ok) return tl::unexpected(ok.error());
        }
      }
    }
    return std::move(counted_);
  }

 private:
  Result<void> add_image(LevelBytes& level, ImagePos image) {
    const Geometry& geometry = stream_.geometry;
    for (size_t m = 0; m < geometry.motion_planes().size(); ++m) {
      const auto& plane = geometry.motion_planes()[m];
      for (uint32_t ty = 0; ty < plane.tiles_y; ++ty) {
        for (uint32_t tx = 0; tx < plane.tiles_x; ++tx) {
          const auto record = find_motion_record(stream_, {level.level, image, m, tx, ty}, Probe{});
          if (!record) return tl::unexpected(record.error());
          if (*record) add(level, level.motion_tiles, (*record)->bits.size() / 8);
        }
      }
    }
    const bool key = geometry.is_key(level.level, image);
    for (const Plane plane : kPlanes) {
      const auto p = static_cast<size_t>(plane);
      if (key) {
        const uint64_t number = geometry.key_number(level.level, image);
        const auto bytes = codestream_bytes(stream_, number, plane);
        if (!bytes) return tl::unexpected(bytes.error());
        add(level, level.key_planes[p], *bytes);
      } else if (auto ok = add_plane(level, image, plane); !ok) {
        return ok;
      }
    }
    return {};
  }

  Result<void> add_plane(LevelBytes& level, ImagePos image, Plane plane) {
    const PlaneShape& shape = stream_.geometry.plane(plane);
    for (uint32_t by = 0; by < shape.blocks_y; by += kTileBlocks) {
      for (uint32_t bx = 0; bx < shape.blocks_x; bx += kTileBlocks) {
        const BlockSite site{level.level, image.row, image.col, plane, bx, by};
        const auto record = find_record(stream_, site, Probe{});
        if (!record) return tl::unexpected(record.error());
        if (!*record) continue;
        add(level, level.planes[static_cast<size_t>(plane)], (*record)->bits.size() / 8);
        if (auto ok = add_residuals(**record, site); !ok) return ok;
      }
    }
    return {};
  }

  Result<void> add_residuals(const TileRecord& record, const BlockSite& site) {
    const TileContext context = tile_context(stream_, site);
    FieldCursor cursor(record.bits, record.file_bit, Probe{});
    const auto head = read_tile_head(cursor, context);
    if (!head) return tl::unexpected(head.error());
    for (uint64_t left = head->residual_mask; left != 0; left &= left - 1) {
      const auto k = static_cast<unsigned>(std::countr_zero(left));
      const auto entry = read_block_entry(cursor, *head, context, k);
      if (!entry) return tl::unexpected(entry.error());
      ++counted_.level_counts[entry->levels.count];
      if (context.steps) ++counted_.steps[static_cast<uint32_t>(entry->step)];
    }
    return {};
  }

  static void add(LevelBytes& level, uint64_t& part, uint64_t bytes) {
    part += bytes;
    level.images.back() += bytes;
  }

  const StreamView& stream_;
  ImageBytes counted_;
};

}  // namespace

Result<ImageBytes> image_bytes(const Decoder& decoder) {
  return Counter(DecoderAccess::stream(decoder)).run();
}

}  // namespace hmlfc::view
