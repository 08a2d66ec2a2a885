// Decoding recorded into command buffers of the caller.
#include <hmlfc/gpu/recording.hpp>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <hmlfc/decoder.hpp>

#include "decoder/open_stream.hpp"
#include "gpu/program.hpp"
#include "stimulus/random_stream.hpp"

namespace hmlfc::gpu {
namespace {

// What the texels of an area are, by what the decoder itself gives for its blocks from `first` on.
void append_expected(const PixelArea& area, const PixelBlocks& blocks, size_t first,
                     const StreamHeader& header, std::vector<uint16_t>& samples) {
  const VkExtent2D extent = texel_extent(area, header);
  const size_t side = header.block_size();
  for (size_t y = 0; y < extent.height; ++y) {
    for (size_t x = 0; x < extent.width; ++x) {
      const size_t block = first + y / side * area.columns + x / side;
      const bool good = blocks.statuses[block] == 0;
      for (size_t lane = 0; lane < 3; ++lane) {
        const size_t at = ((3 * block + lane) * side + y % side) * side + x % side;
        samples.push_back(static_cast<uint16_t>(blocks.samples[at]));
      }
      samples.push_back(static_cast<uint16_t>(good ? (1 << header.depth) - 1 : 0));
    }
  }
}

std::vector<uint16_t> expected(std::span<const PixelArea> areas, const PixelBlocks& blocks,
                               const StreamHeader& header) {
  std::vector<uint16_t> samples;
  size_t first = 0;
  for (const PixelArea& area : areas) {
    append_expected(area, blocks, first, header, samples);
    first += size_t{area.columns} * area.rows;
  }
  return samples;
}

PixelArea whole_view(const StreamView& stream, ViewPos view) {
  const PlaneShape& plane = stream.geometry.plane(Plane::kY);
  return {view, 0, 0, plane.blocks_x, plane.blocks_y, 0};
}

// A single block, rectangles that end beyond the view, one beyond it and a view that is not there.
std::vector<PixelArea> some_areas(const StreamView& stream) {
  const PlaneShape& plane = stream.geometry.plane(Plane::kY);
  const ViewPos last{stream.header.rows - 1, stream.header.cols - 1};
  return {{{0, 0}, plane.blocks_x - 1, plane.blocks_y - 1, 1, 1, 0},
          {last, plane.blocks_x / 2, 0, plane.blocks_x, 2, 0},
          {{0, 0}, 0, plane.blocks_y, 2, 1, 0},
          {{0, 0}, 0x7FFFFFFF, 0x7FFFFFFF, 3, 2, 0},
          {{stream.header.rows, 0}, 0, 0, 2, 1, 0},
          {{0, 0}, 0, 0, 2, plane.blocks_y + 1, stream.header.tree_height}};
}

class GpuRecording : public ProgramTest {
 protected:
  // Records to a buffer after 16 other bytes, and runs twice.
  void expect_recorded(GpuDecoder& decoder, std::span<const PixelArea> areas,
                       const StreamHeader& header) {
    const auto blocks = decoder.decode_rgb(areas);
    ASSERT_TRUE(blocks) << blocks.error().message;
    const auto samples = expected(areas, *blocks, header);
    const size_t bytes = samples.size() * texel_bytes(header) / 4;
    const Buffer to = target(16 + bytes + 16);
    std::optional<Recording> recording;
    const ProgramCommands commands(program(), [&](const vk::raii::CommandBuffer& buffer) {
      auto recorded = record(decoder, *buffer, areas, BufferTarget{to.handle(), 16});
      ASSERT_TRUE(recorded) << recorded.error().message;
      recording.emplace(std::move(*recorded));
    });
    ASSERT_TRUE(recording);
    for (int run = 0; run < 2; ++run) {
      std::ranges::fill(to.bytes(), uint8_t{0xEE});
      commands.run();
      EXPECT_EQ(recording->statuses(), blocks->statuses);
      EXPECT_EQ(samples_of(to.bytes().subspan(16, bytes), header), samples);
      for (size_t i = 0; i < 16; ++i) {
        EXPECT_EQ(to.bytes()[i], 0xEE);
        EXPECT_EQ(to.bytes()[16 + bytes + i], 0xEE);
      }
    }
  }
};

TEST_F(GpuRecording, OfAWholeViewIsTheModels) {
  std::set<std::pair<int, ChromaFormat>> kinds;
  for (uint32_t seed = 0; seed < 16; ++seed) {
    const auto bytes = stream_of(seed);
    const auto model = Decoder::open(bytes);
    ASSERT_TRUE(model);
    const StreamHeader& header = model->header();
    kinds.emplace(header.depth == 8 ? 8 : 16, header.chroma_format);
    auto decoder = GpuDecoder::open(program(), *model);
    ASSERT_TRUE(decoder) << decoder.error().message;
    const PixelArea area = whole_view(DecoderAccess::stream(*model), {0, 0});
    const auto view = model->decode_view({0, 0});
    ASSERT_TRUE(view);
    const Buffer to = target(uint64_t{header.width} * header.height * texel_bytes(header));
    std::optional<Recording> recording;
    ProgramCommands(program(), [&](const vk::raii::CommandBuffer& buffer) {
      auto recorded = record(*decoder, *buffer, {&area, 1}, BufferTarget{to.handle(), 0});
      ASSERT_TRUE(recorded) << recorded.error().message;
      recording.emplace(std::move(*recorded));
    }).run();
    const auto samples = samples_of(to.bytes(), header);
    for (size_t i = 0; i < samples.size(); ++i) {
      const int most = (1 << header.depth) - 1;
      ASSERT_EQ(samples[i], i % 4 == 3 ? most : view->samples[i / 4 * 3 + i % 4]) << i;
    }
  }
  EXPECT_EQ(kinds.size(), 4u);
}

TEST_F(GpuRecording, OfAnyAreasIsTheDecoders) {
  for (uint32_t seed = 0; seed < 12; ++seed) {
    auto bytes = stream_of(seed);
    if (seed % 4 >= 2) tb::corrupt(bytes, tb::Damage::kIndexAndTiles, seed);
    OpenOptions options;
    options.check_sections = false;
    const auto view = open_stream(bytes, options);
    if (!view) continue;
    auto decoder = GpuDecoder::open(program(), *view);
    ASSERT_TRUE(decoder) << decoder.error().message;
    expect_recorded(*decoder, some_areas(*view), view->header);
  }
}

// Tiles to places of the second layer of an image, in turned order; nothing else changes.
TEST_F(GpuRecording, ToAnImagePutsEachAreaToItsPlace) {
  for (uint32_t seed = 0; seed < 4; ++seed) {
    const auto bytes = stream_of(seed);
    const auto view = open_stream(bytes, {});
    ASSERT_TRUE(view);
    const StreamHeader& header = view->header;
    auto decoder = GpuDecoder::open(program(), *view);
    ASSERT_TRUE(decoder) << decoder.error().message;
    const PlaneShape& plane = view->geometry.plane(Plane::kY);
    const std::vector<PixelArea> areas{{{0, 0}, plane.blocks_x - 1, 0, 2, 1, 0},
                                       {{0, 0}, 0, 0, 1, 1, 0},
                                       {{0, 0}, plane.blocks_x, 0, 1, 1, 0}};
    const std::vector<TexelPlace> places{{0, 0, 1}, {9, 3, 1}, {0, 0, 0}};
    constexpr uint32_t kSide = 32;
    const ProgramImage image(program(), kSide, header);
    const Buffer to = target(uint64_t{2} * kSide * kSide * texel_bytes(header));
    std::optional<Recording> recording;
    ProgramCommands(program(), [&](const vk::raii::CommandBuffer& buffer) {
      image.clear(buffer);
      ImageTarget target;
      target.image = image.handle();
      target.places = places;
      auto recorded = record(*decoder, *buffer, areas, target);
      ASSERT_TRUE(recorded) << recorded.error().message;
      recording.emplace(std::move(*recorded));
      image.read(buffer, to.handle());
    }).run();
    const auto blocks = decoder->decode_rgb(areas);
    ASSERT_TRUE(blocks);
    const auto texels = expected(areas, *blocks, header);
    std::vector<uint16_t> samples(size_t{8} * kSide * kSide);
    auto from = texels.begin();
    for (size_t i = 0; i < areas.size(); ++i) {
      const VkExtent2D extent = texel_extent(areas[i], header);
      for (uint32_t y = 0; y < extent.height; ++y) {
        const size_t row = (places[i].layer * kSide + places[i].y + y) * size_t{kSide};
        std::copy_n(from, 4 * extent.width,
                    samples.begin() + static_cast<ptrdiff_t>(4 * (row + places[i].x)));
        from += 4 * extent.width;
      }
    }
    EXPECT_EQ(samples_of(to.bytes(), header), samples);
  }
}

TEST_F(GpuRecording, OfTooManyBlocksOrPlacesIsRefused) {
  const auto bytes = tb::suite_stream(2, 4);
  const auto view = open_stream(bytes, {});
  ASSERT_TRUE(view);
  DeviceOptions options;
  options.submission_bytes = 1;
  auto small = open(options);
  ASSERT_TRUE(small);
  auto decoder = GpuDecoder::open(*small, *view);
  ASSERT_TRUE(decoder);
  const std::vector<PixelArea> areas{{{0, 0}, 0, 0, 1, 1, 0}, {{0, 0}, 0, 0, 1, 1, 0}};
  const Buffer to(small->state(), 1024, Memory::kReadback);
  ProgramCommands(*small, [&](const vk::raii::CommandBuffer& buffer) {
    const auto many = record(*decoder, *buffer, areas, BufferTarget{to.handle(), 0});
    ASSERT_FALSE(many);
    EXPECT_EQ(many.error().kind, FailureKind::kLimit);
    EXPECT_NE(many.error().message.find("1 of plane Y"), std::string::npos);
    const auto places = record(*decoder, *buffer, areas, ImageTarget{});
    ASSERT_FALSE(places);
    EXPECT_NE(places.error().message.find("0 places for 2 areas"), std::string::npos);
    const auto none = record(*decoder, *buffer, {}, BufferTarget{to.handle(), 0});
    ASSERT_TRUE(none);
    EXPECT_TRUE(none->statuses().empty());
  }).run();
}

}  // namespace
}  // namespace hmlfc::gpu
