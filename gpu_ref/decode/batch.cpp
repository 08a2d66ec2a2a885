#include "batch.hpp"

#include <algorithm>

#include "arithmetic/rounding.hpp"
#include "device/commands.hpp"
#include "stream_shape.hpp"

namespace hmlfc::gpu {
namespace {

constexpr uint64_t kMaxRequests = uint64_t{1} << 24;  // of a submission

// A rectangle of blocks, and parts of it.
struct BlockGrid {
  uint32_t bx, by, columns, rows;
  uint64_t blocks() const { return uint64_t{columns} * rows; }
};

// Calls `use(part)` for parts of at most `limit` blocks of `grid`, in its order: whole rows where a
// row fits, else pieces of rows.
template <class Use>
void for_each_part(const BlockGrid& grid, uint64_t limit, const Use& use) {
  const auto columns = static_cast<uint32_t>(std::min<uint64_t>(grid.columns, limit));
  const bool whole_rows = columns == grid.columns;
  const auto rows =
      whole_rows ? static_cast<uint32_t>(std::min<uint64_t>(grid.rows, limit / grid.columns)) : 1u;
  for (uint64_t y = 0; y < grid.rows; y += rows) {
    for (uint64_t x = 0; x < grid.columns; x += columns) {
      use(BlockGrid{grid.bx + static_cast<uint32_t>(x), grid.by + static_cast<uint32_t>(y),
                    static_cast<uint32_t>(std::min<uint64_t>(columns, grid.columns - x)),
                    static_cast<uint32_t>(std::min<uint64_t>(rows, grid.rows - y))});
    }
  }
}

// The batch that has room for `requests` more.
Batch& batch_with_room(std::vector<Batch>& batches, uint64_t requests, uint64_t limit) {
  if (batches.empty() || batches.back().requests + requests > limit) batches.emplace_back();
  return batches.back();
}

// One plane of a part of an area.
template <class Area>
AreaRecord record_of(const Area& area, Plane plane, const BlockGrid& part) {
  AreaRecord record;
  record.row = area.view.row;
  record.col = area.view.col;
  record.plane = static_cast<uint32_t>(plane);
  record.level = static_cast<uint32_t>(area.stop_level);
  record.bx = part.bx;
  record.by = part.by;
  record.columns = part.columns;
  return record;
}

// The chroma blocks of blocks of plane Y (COL-3).
BlockGrid chroma_of(const BlockGrid& luma, ChromaFormat format) {
  if (format == ChromaFormat::k444) return luma;
  const uint32_t bx = luma.bx >> 1;
  const uint32_t by = luma.by >> 1;
  return {bx, by, ((luma.bx + luma.columns - 1) >> 1) - bx + 1,
          ((luma.by + luma.rows - 1) >> 1) - by + 1};
}

void add_pixels(const PixelArea& area, const BlockGrid& part, ChromaFormat format, Batch& batch) {
  const BlockGrid chroma = chroma_of(part, format);
  ColourAreaRecord colour;
  colour.first_block = static_cast<uint32_t>(batch.pixels);
  colour.columns = part.columns;
  colour.bx = part.bx;
  colour.by = part.by;
  colour.chroma_bx = chroma.bx;
  colour.chroma_by = chroma.by;
  colour.chroma_columns = chroma.columns;
  colour.luma = static_cast<uint32_t>(batch.requests);
  batch.add(record_of(area, Plane::kY, part), part.rows);
  colour.co = static_cast<uint32_t>(batch.requests);
  batch.add(record_of(area, Plane::kCo, chroma), chroma.rows);
  colour.cg = static_cast<uint32_t>(batch.requests);
  batch.add(record_of(area, Plane::kCg, chroma), chroma.rows);
  batch.colour_areas.push_back(colour);
  batch.pixels += part.blocks();
}

// All planes of one reference image of level `l`.
void add_reference(const Geometry& geometry, int l, ImagePos image, uint64_t limit,
                   std::vector<Batch>& batches) {
  for (const Plane plane : kPlanes) {
    const PlaneShape& shape = geometry.plane(plane);
    for_each_part({0, 0, shape.blocks_x, shape.blocks_y}, limit, [&](const BlockGrid& part) {
      AreaRecord record = record_of(BlockArea{{image.row, image.col}, plane}, plane, part);
      record.level = static_cast<uint32_t>(l);
      record.exact = 1;
      batch_with_room(batches, part.blocks(), limit).add(record, part.rows);
    });
  }
}

template <class Record>
uint64_t write_records(Device::State& device, GrowingBuffer& buffer,
                       const std::vector<Record>& records) {
  Buffer& target = buffer.reserve(device, records.size() * sizeof(Record));
  std::ranges::copy(records, target.records<Record>().begin());
  return target.address();
}

}  // namespace

void Batch::add(const AreaRecord& area, uint32_t rows) {
  areas.push_back(area);
  areas.back().first_request = static_cast<uint32_t>(requests);
  requests += uint64_t{area.columns} * rows;
}

std::vector<Batch> batches_of(std::span<const BlockArea> areas, uint64_t limit) {
  std::vector<Batch> batches;
  for (const BlockArea& area : areas) {
    for_each_part({area.bx, area.by, area.columns, area.rows}, limit, [&](const BlockGrid& part) {
      batch_with_room(batches, part.blocks(), limit)
          .add(record_of(area, area.plane, part), part.rows);
    });
  }
  return batches;
}

std::vector<Batch> batches_of(std::span<const PixelArea> areas, ChromaFormat format,
                              uint64_t limit) {
  std::vector<Batch> batches;
  for (const PixelArea& area : areas) {
    // A part has no more blocks of a chroma plane than of plane Y.
    for_each_part({area.bx, area.by, area.columns, area.rows}, limit / 3,
                  [&](const BlockGrid& part) {
                    Batch& batch = batch_with_room(batches, 3 * part.blocks(), limit);
                    add_pixels(area, part, format, batch);
                  });
  }
  return batches;
}

std::array<uint32_t, 2> pixels_of(const PixelArea& area, const StreamHeader& header) {
  const uint64_t side = header.block_size();
  const auto inside = [side](uint32_t first, uint32_t blocks, uint32_t size) {
    const uint64_t begin = std::min<uint64_t>(first * side, size);
    return static_cast<uint32_t>(std::min<uint64_t>(blocks * side, size - begin));
  };
  return {inside(area.bx, area.columns, header.width), inside(area.by, area.rows, header.height)};
}

void number_texels(std::span<const PixelArea> areas, const StreamHeader& header, Batch& batch) {
  for (size_t i = 0; i < areas.size(); ++i) {
    batch.colour_areas[i].first_texel = static_cast<uint32_t>(batch.texels);
    const auto [columns, rows] = pixels_of(areas[i], header);
    batch.texels += uint64_t{columns} * rows;
  }
}

std::vector<Batch> reference_batches(const Geometry& geometry, uint64_t limit) {
  std::vector<Batch> batches;
  for (int l = 0; l <= geometry.top(); ++l) {
    const LevelShape& level = geometry.level(l);
    if (level.keyed || !has_references(level)) continue;
    for (uint32_t row = 0; row < level.group_rows(); ++row) {
      for (uint32_t col = 0; col < level.group_cols(); ++col) {
        add_reference(geometry, l, geometry.reference_of_group(l, {row, col}), limit, batches);
      }
    }
  }
  return batches;
}

BlockSizes block_sizes(const StreamHeader& header) {
  return {static_cast<uint32_t>(header.tree_height) + 1,
          header.block_size() * header.block_size() / 2, header.depth == 8 ? 4u : 8u};
}

uint64_t max_requests(const Device::State& device, const BlockSizes& sizes, bool trace) {
  // A status and the samples twice, on the device and on the host; three lanes of pixels.
  const uint64_t bytes = kRequestBytes + sizes.entry_bytes() + 8 + 4 * sizes.sample_bytes() +
                         (trace ? 2 * sizes.stage_bytes() : 0);
  const uint64_t budget = std::min(device.submission_bytes, device.max_buffer_bytes);
  const uint64_t invocations = kMaxInvocations / std::max(sizes.sample_words, sizes.levels);
  return std::min({budget / bytes, invocations, kMaxRequests});
}

Arguments BatchBuffers::prepare_requests(Device::State& device, uint64_t count,
                                         const BlockSizes& sizes, Arguments arguments) {
  arguments.request_count = static_cast<uint32_t>(count);
  arguments.requests = requests.reserve(device, count * kRequestBytes).address();
  arguments.entries = entries.reserve(device, count * sizes.entry_bytes()).address();
  arguments.statuses = statuses.reserve(device, count * 4).address();
  return arguments;
}

Arguments BatchBuffers::prepare(Device::State& device, const Batch& batch, const BlockSizes& sizes,
                                KernelUse use, Arguments arguments) {
  arguments = prepare_requests(device, batch.requests, sizes, arguments);
  arguments.areas = write_records(device, areas, batch.areas);
  arguments.area_count = static_cast<uint32_t>(batch.areas.size());
  arguments.samples = samples.reserve(device, batch.requests * sizes.sample_bytes()).address();
  if (use == KernelUse::kStages) {
    arguments.stages = stages.reserve(device, batch.requests * sizes.stage_bytes()).address();
  }
  if (batch.pixels != 0) {
    arguments.colour_areas = write_records(device, colour_areas, batch.colour_areas);
    arguments.colour_area_count = static_cast<uint32_t>(batch.colour_areas.size());
    arguments.pixel_count = static_cast<uint32_t>(batch.pixels);
    const uint64_t bytes = use == KernelUse::kTexels ? batch.texels * sizes.texel_bytes
                                                     : batch.pixels * 3 * sizes.sample_bytes();
    arguments.pixels = pixels.reserve(device, bytes).address();
    arguments.pixel_statuses = pixel_statuses.reserve(device, batch.pixels * 4).address();
  }
  return arguments;
}

}  // namespace hmlfc::gpu
