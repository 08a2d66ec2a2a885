// A decoder on a partial source: the same answers, few rounds, and after a failure no answer.
#include <algorithm>
#include <cstdint>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include <hmlfc/disparity.hpp>
#include <hmlfc/focus.hpp>
#include <hmlfc/renderer.hpp>

#include "render/render_cases.hpp"
#include "support/lazy_source.hpp"
#include "vectors/field_stream.hpp"

namespace hmlfc {
namespace {

using test::LazySource;
using Bytes = std::vector<uint8_t>;

constexpr OpenOptions kUnchecked{.check_sections = false};

// A value or a named error as numbers, to be compared.
struct Outcome {
  std::vector<int64_t> values;
  friend bool operator==(const Outcome&, const Outcome&) = default;
};

Outcome failed(const Error& error) {
  return {{-1, static_cast<int64_t>(error.code), static_cast<int64_t>(error.section),
           static_cast<int64_t>(error.offset)}};
}

template <class Value, class Numbers>
Outcome outcome(const Result<Value>& result, const Numbers& numbers) {
  return result ? Outcome{numbers(*result)} : failed(result.error());
}

template <class Container>
std::vector<int64_t> as_numbers(const Container& values) {
  return {values.begin(), values.end()};
}

std::vector<int64_t> map_numbers(const DisparityMap& map) {
  std::vector<int64_t> numbers;
  for (const BlockDisparity& block : map.blocks) {
    numbers.push_back(block.disparity * 256 + block.confidence);
  }
  return numbers;
}

std::vector<int64_t> frame_numbers(const Frame& frame) {
  std::vector<int64_t> numbers = as_numbers(frame.image.samples);
  const FrameCounts& counts = frame.counts;
  for (const uint64_t count :
       {counts.blocks_needed, counts.blocks_decoded, counts.disparities_looked_up}) {
    numbers.push_back(static_cast<int64_t>(count));
  }
  return numbers;
}

// All that a decoder answers, each kind of request for a place drawn from `seed`.
class Questions {
 public:
  Questions(const Decoder& decoder, uint32_t seed) : decoder_(decoder), random_(seed) {
    const StreamHeader& header = decoder.header();
    view_ = {random_() % header.rows, random_() % header.cols};
    plane_ = static_cast<Plane>(random_() % 3);
    level_ = static_cast<int>(random_() % static_cast<uint32_t>(header.tree_height + 1));
    const PlaneSize size = decoder.plane_size(plane_);
    rect_.x = random_() % size.width;
    rect_.y = random_() % size.height;
    rect_.width = 1 + random_() % (size.width - rect_.x);
    rect_.height = 1 + random_() % (size.height - rect_.y);
  }

  std::vector<Outcome> ask() {
    return {ask_block(),      ask_rect(),      ask_view(),      ask_all(),
            ask_statistics(), ask_disparity(), ask_focus(),     ask_frame(0),
            ask_frame(1),     ask_frame(2),    ask_references()};
  }

 private:
  Outcome ask_block() const {
    const uint32_t side = decoder_.header().block_size();
    const BlockAddress block{view_, plane_, rect_.x / side, rect_.y / side};
    return outcome(decoder_.decode_block(block, {.stop_level = level_}),
                   as_numbers<std::vector<int32_t>>);
  }
  Outcome ask_rect() const {
    return outcome(decoder_.decode_rect(view_, plane_, rect_, level_),
                   as_numbers<std::vector<int16_t>>);
  }
  Outcome ask_view() const {
    return outcome(decoder_.decode_view(view_, level_),
                   [](const RgbImage& image) { return as_numbers(image.samples); });
  }
  Outcome ask_all() const {
    std::map<uint32_t, std::vector<int64_t>> views;
    const auto done = decoder_.decode_all(
        [&](ViewPos view, RgbImage&& image) {
          views[view.row * 5000 + view.col] = as_numbers(image.samples);
        },
        {level_, 1});
    if (!done) return failed(done.error());
    Outcome all;
    for (const auto& [place, samples] : views) {
      all.values.insert(all.values.end(), samples.begin(), samples.end());
    }
    return all;
  }
  Outcome ask_statistics() const {
    return outcome(decoder_.statistics(), [](const StreamStatistics& found) {
      auto numbers = as_numbers(found.states);
      numbers.push_back(
          static_cast<int64_t>(found.sections.motion * 1000000 + found.sections.residual));
      return numbers;
    });
  }
  Outcome ask_disparity() const { return outcome(disparity_map(decoder_, view_), map_numbers); }
  Outcome ask_focus() {
    const Camera camera;
    return outcome(
        focus_at(decoder_, camera, random_() % 4, random_() % 4), [](const FocusPoint& point) {
          return std::vector<int64_t>{static_cast<int64_t>(point.sight), point.disparity};
        });
  }
  Outcome ask_frame(uint32_t number) {
    const Camera camera = test::random_camera_with_geometry(random_, decoder_.header());
    const auto record = frame_record(camera, decoder_.header());
    if (!record) return {{-2}};
    if (renderer_ == nullptr || number == 2) {
      renderer_ = make_cpu_renderer(decoder_, {.progressive = number == 2});
    }
    Frame frame;
    const auto done = renderer_->render(*record, level_, frame);
    return done ? Outcome{frame_numbers(frame)} : failed(done.error());
  }
  Outcome ask_references() const {
    const auto done = decoder_.load_references(1);
    return done ? Outcome{} : failed(done.error());
  }

  const Decoder& decoder_;
  test::Random random_;
  ViewPos view_;
  Plane plane_ = Plane::kY;
  Rect rect_;
  int level_ = 0;
  std::unique_ptr<FrameRenderer> renderer_;
};

// A stream of either kind, every third one damaged.
Bytes some_stream(uint32_t seed) {
  Bytes file = seed % 2 == 0 ? test::random_stream(seed) : vectors::random_stream(seed, {});
  test::Random random(seed);
  if (seed % 3 == 2) test::damage(random, file);
  return file;
}

TEST(PartialSource, SameAnswersAsInMemory) {
  size_t opened = 0;
  for (uint32_t seed = 0; seed < 60; ++seed) {
    const Bytes file = some_stream(seed);
    LazySource source(file);
    const auto decoder = Decoder::open(file, kUnchecked);
    const auto lazy = Decoder::open(source, kUnchecked);
    ASSERT_EQ(decoder.has_value(), lazy.has_value()) << "seed " << seed;
    if (!decoder) continue;
    ++opened;
    const auto expected = Questions(*decoder, seed).ask();
    const auto found = Questions(*lazy, seed).ask();
    for (size_t i = 0; i < expected.size(); ++i) {
      EXPECT_EQ(expected[i] == found[i], true) << "seed " << seed << ", question " << i;
    }
  }
  EXPECT_GT(opened, 40u);
}

TEST(PartialSource, SectionChecksLoadTheSections) {
  Bytes file = test::random_stream(4);
  LazySource intact(file);
  EXPECT_TRUE(Decoder::open(intact));
  file.back() ^= 1;
  LazySource damaged(file);
  const auto opened = Decoder::open(damaged);
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, ErrorCode::kBadSectionCrc);
}

TEST(PartialSource, HeadersThatEndEarly) {
  const Bytes file = test::random_stream(4);
  for (const size_t size : {0u, 1u, 8u, 11u, 12u, 40u, 100u}) {
    const Bytes cut(file.begin(), file.begin() + static_cast<ptrdiff_t>(size));
    LazySource source(cut);
    const auto expected = Decoder::open(cut);
    const auto found = Decoder::open(source);
    ASSERT_FALSE(found) << size;
    EXPECT_EQ(found.error().code, expected.error().code) << size;
    EXPECT_EQ(found.error().offset, expected.error().offset) << size;
  }
}

// The bytes that requests read, each 1.
class ReadBytes final : public ReadSink {
 public:
  explicit ReadBytes(size_t size) : read(size) {}
  void on_read(uint64_t offset, uint64_t bytes) override {
    std::fill_n(read.begin() + static_cast<ptrdiff_t>(offset), bytes, uint8_t{1});
  }
  Bytes read;
};

TEST(PartialSource, RoundsAreFewAndLoadWhatIsRead) {
  for (uint32_t seed = 0; seed < 40; ++seed) {
    const Bytes file = seed % 2 == 0 ? test::random_stream(seed) : vectors::random_stream(seed, {});
    ReadBytes reads(file.size());
    OpenOptions options = kUnchecked;
    options.reads = &reads;
    const auto decoder = Decoder::open(file, options);
    LazySource source(file);
    const auto lazy = Decoder::open(source, kUnchecked);
    ASSERT_TRUE(decoder && lazy) << "seed " << seed;
    const StreamHeader& header = decoder->header();
    const ViewPos view{header.rows / 2, header.cols / 3};
    const bool decoded = decoder->decode_view(view).has_value();
    const size_t opening = source.loads();
    EXPECT_EQ(lazy->decode_view(view).has_value(), decoded);
    // Four reads of a tile, then four of the tiles of its references; motion tiles come before, and
    // disparities between. A key image is found through the TOP table.
    size_t rounds = 8;
    if (header.has(Feature::kSharedDisparity)) rounds += 4;
    EXPECT_LE(source.loads() - opening, rounds) << "seed " << seed;
    EXPECT_EQ(source.loaded() == reads.read, true) << "seed " << seed;
  }
}

TEST(PartialSource, AfterAFailureNoAnswer) {
  for (uint32_t seed = 0; seed < 8; ++seed) {
    const Bytes file = seed % 2 == 0 ? test::random_stream(seed) : vectors::random_stream(seed, {});
    LazySource counted(file);
    const auto whole = Decoder::open(counted, kUnchecked);
    ASSERT_TRUE(whole);
    const auto expected = Questions(*whole, seed).ask();
    const Outcome bus_error = failed({ErrorCode::kBusError, Section::kHeader, 0});
    for (size_t n = 0; n < counted.loads(); ++n) {
      LazySource source(file, n);
      const auto decoder = Decoder::open(source, kUnchecked);
      if (!decoder) {
        EXPECT_EQ(decoder.error().code, ErrorCode::kBusError);
        continue;
      }
      const auto found = Questions(*decoder, seed).ask();
      bool failing = false;
      for (size_t i = 0; i < found.size(); ++i) {
        failing = failing || found[i] == bus_error;
        const bool no_frame = expected[i] == Outcome{{-2}};
        EXPECT_EQ(found[i] == (failing && !no_frame ? bus_error : expected[i]), true)
            << "seed " << seed << ", load " << n << ", question " << i;
      }
      EXPECT_TRUE(failing) << "seed " << seed << ", load " << n;
    }
  }
}

}  // namespace
}  // namespace hmlfc
