// Runs of the view unit on one stream, by seed; each leaves the bench's finding empty if all was
// right.
#pragma once

#include <algorithm>
#include <vector>

#include "arithmetic/rounding.hpp"
#include "scenes/test_light_fields.hpp"
#include "stimulus/random_stream.hpp"
#include "stimulus/sequences.hpp"
#include "systemc/stream_image.hpp"
#include "unit/units.hpp"
#include "view/view_bench.hpp"

namespace hmlfc::tb {

constexpr unsigned kRing = 4;

inline constexpr ViewFormat kViewFormats[]{ViewFormat::kY,         ViewFormat::kCo,
                                           ViewFormat::kCg,        ViewFormat::kRgb888,
                                           ViewFormat::kRgb101010, ViewFormat::kRgb161616};

/// One stream and a unit for it. `bytes` must outlive it.
class ViewRun {
 public:
  ViewRun(std::span<const uint8_t> bytes, const UnitMaker& maker, uint64_t seed)
      : maker_(maker),
        image_(bytes, maker.parameters),
        random_(seed),
        bench_(maker.make(maker.parameters.with_state(seed), &image_.oracle()), bytes,
               image_.area().bytes, image_.oracle(), kRing) {}

  const std::string& finding() const { return bench_.finding(); }
  ViewBench& bench() { return bench_; }

  /// The whole of one view in every format, in turns of at most as many descriptors as fit.
  void whole_views() {
    std::vector<Descriptor> all;
    for (const ViewFormat format : kViewFormats) all.push_back(whole(format));
    run(all);
  }

  /// The whole of the first view in a format.
  void whole_view(ViewFormat format) { run({whole(format)}); }

  /// `count` rectangles of random views, planes and levels.
  void rectangles(unsigned count) {
    std::vector<Descriptor> all;
    for (unsigned i = 0; i < count; ++i) {
      all.push_back(rectangle(kViewFormats[random_.below(std::size(kViewFormats))]));
    }
    run(all);
  }

  /// Reference images of every level in turn, and an image of any kind, as strips.
  void residuals() {
    std::vector<Descriptor> all;
    const Geometry& geometry = image_.golden()->geometry();
    for (int l = 0; l <= geometry.top(); ++l) {
      const LevelShape& level = geometry.level(l);
      const ImagePos group{random_.below(level.group_rows()), random_.below(level.group_cols())};
      all.push_back(strips(l, geometry.reference_of_group(l, group)));
      all.push_back(strips(l, {random_.below(level.rows), random_.below(level.cols)}));
    }
    run(all);
  }

  /// Descriptors that must be refused, between others.
  void refused() {
    std::vector<Descriptor> all;
    for (unsigned i = 0; i < 17; ++i) {
      Descriptor d = i < 14 ? rectangle(ViewFormat::kRgb161616) : strips(0, {});
      bench_.host().allocate(d, 0, true);
      if (i == 1) d.x += 1;
      if (i == 2) d.y += 1;
      if (i == 3) d.width = 0;
      if (i == 4) d.height = 0;
      if (i == 5) d.width = 16384 - d.x + 1;
      if (i == 6) d.height = 65535;
      if (i == 7) d.destination += 8;
      if (i == 8) d.destination |= uint64_t{1} << 40;
      if (i == 9) d.pitch += 4;
      if (i == 10) d.pitch = 1u << 24;
      if (i == 11) d.bitmap += 4;
      if (i == 12) d.bitmap |= uint64_t{1} << 50;
      if (i == 13) d.format = static_cast<ViewFormat>(7);
      if (i == 14) d.x = maker_.parameters.block_size();
      if (i == 15) d.y = maker_.parameters.block_size();
      if (i == 16) d.bitmap = d.destination + 8;
      d.tag = next_tag_++;
      all.push_back(d);
    }
    all[3].format = static_cast<ViewFormat>(3);
    all[4].format = static_cast<ViewFormat>(11);
    in_turns(all, [&](auto turn) { bench_.run(turn); });
  }

  /// Rows of each width, some of which end a byte after a line, at each place in a line; rows so
  /// far apart that the pitch has more than 16 bits.
  void edges() {
    for (uint32_t i = 0; i < 64 && finding().empty(); ++i) {
      Descriptor d = whole(ViewFormat::kRgb888);
      d.width = std::min(i / 4 + 1, d.width);
      d.height = 1;
      bench_.host().allocate(d, 64, false);
      d.destination += (i - d.destination / 16) % 4 * 16;
      bench_.run(std::span(&d, 1));
      bench_.host().free_all();
    }
    Descriptor d = whole(ViewFormat::kRgb161616);
    d.height = std::min(2 * maker_.parameters.block_size() + 1, d.height);
    bench_.host().allocate(d, 65536 * random_.within(1, 4) + 16 * random_.below(4096), true);
    bench_.run(std::span(&d, 1));
    bench_.host().free_all();
  }

  /// Events that rise in the clock in which software clears them.
  void cleared() {
    for (int i = 0; i < 24 && finding().empty(); ++i) {
      bench_.run_cleared(prepared(rectangle(ViewFormat::kY)));
      bench_.host().free_all();
    }
  }

  /// What only a whole unit has: LOAD before, and at the time of, descriptors.
  void loads() {
    for (int i = 0; i < 3 && finding().empty(); ++i) {
      std::vector<Descriptor> all;
      for (unsigned k = 0; k < kRing; ++k) all.push_back(prepared(rectangle(kViewFormats[k])));
      if (i == 0)
        bench_.run_before_load(all);
      else
        bench_.run_during_load(all);
      bench_.host().free_all();
    }
  }

  /// Blocks after the plane's last, and a view that does not exist.
  void outside() {
    const unsigned b = maker_.parameters.block_size();
    Descriptor d = whole(ViewFormat::kRgb161616);
    d.x = ceil_div(d.width, b) * b;
    d.width = 3 * b + 1;
    d.height = std::min(d.height, 2 * b);
    Descriptor other = whole(ViewFormat::kCo);
    other.row = 4095;
    run({d, other});
  }

  /// Writes fail, then the descriptor cannot be read; the next is as if nothing had been.
  void bus_errors() {
    for (const bool bitmap : {false, true}) {
      Descriptor d = prepared(whole(ViewFormat::kRgb161616));
      const uint64_t begin = bitmap ? d.bitmap : d.destination;
      bench_.run_with_fault(d, {begin, begin + 1});
    }
    rectangles(3);
    Descriptor unread = prepared(whole(ViewFormat::kY));
    bench_.run_with_fault(unread,
                          {bench_.host().ring_base(), bench_.host().ring_base() + kRing * 64});
    rectangles(3);
  }

  /// The driver fills the reference area.
  void area() {
    const uint64_t seed = random_.next();
    bench_.host().memory().start(random_conditions(seed), seed);
    bench_.fill_area();
  }

  /// Aborts at many moments of a descriptor; then DRAIN, a reset, and everything works as before.
  void interruptions() {
    for (unsigned clocks = 0; clocks < 400; clocks += random_.within(1, 70)) {
      const Descriptor d =
          prepared(random_.chance(500) ? whole(ViewFormat::kRgb161616) : strips(0, {}));
      bench_.run_aborted(d, clocks, prepared(rectangle(ViewFormat::kY)));
      if (!finding().empty()) return;
      bench_.host().free_all();
    }
    bench_.run_drained(std::vector{prepared(rectangle(ViewFormat::kRgb161616)),
                                   prepared(rectangle(ViewFormat::kRgb101010))});
    bench_.host().free_all();
    for (uint32_t i = 0; i < 8; ++i) {
      const Descriptor d = prepared(whole(ViewFormat::kRgb161616));
      if (i < 6)
        bench_.run_reset(d, random_.below(500), i % 2 == 0);
      else
        bench_.run_hung(d, (i - 6) * random_.below(500));
      bench_.host().free_all();
      rectangles(2);
    }
  }

  /// Ends at the first finding.
  void everything() {
    whole_views();
    rectangles(20);
    residuals();
    refused();
    outside();
    edges();
    cleared();
    bus_errors();
    area();
    interruptions();
  }

 private:
  Descriptor whole(ViewFormat format) {
    const auto& header = image_.golden()->header();
    const PlaneShape& plane = image_.golden()->geometry().plane(
        format <= ViewFormat::kCg ? static_cast<Plane>(format) : Plane::kY);
    return {.row = random_.below(header.rows),
            .col = random_.below(header.cols),
            .stop_level = random_.chance(700) ? 0 : random_.below(uint64_t(header.tree_height) + 1),
            .format = format,
            .width = plane.width,
            .height = plane.height};
  }

  // A plane of the image of level `l`.
  Descriptor strips(int l, ImagePos image) {
    const auto& header = image_.golden()->header();
    const unsigned plane = random_.below(3);
    Descriptor d = whole(static_cast<ViewFormat>(plane));
    d.format = static_cast<ViewFormat>(8 + plane);
    d.stop_level = static_cast<unsigned>(l);
    d.row = image.row;
    d.col = image.col;
    for (int i = 0; i < l; ++i) {
      d.row *= header.cluster_rows;
      d.col *= header.cluster_cols;
    }
    return d;
  }

  Descriptor rectangle(ViewFormat format) {
    const unsigned b = maker_.parameters.block_size();
    Descriptor d = whole(format);
    d.x = random_.below(ceil_div(d.width, b)) * b;
    d.y = random_.below(ceil_div(d.height, b)) * b;
    d.width = random_.within(1, d.width - d.x);
    d.height = random_.within(1, d.height - d.y);
    return d;
  }

  Descriptor prepared(Descriptor d) {
    bench_.host().allocate(d, random_.below(4) * 16, true);
    d.tag = next_tag_++;
    return d;
  }

  void run(std::vector<Descriptor> all) {
    in_turns(all, [&](auto turn) {
      for (Descriptor& d : turn) {
        bench_.host().allocate(d, random_.below(4) * 16, random_.chance(800));
        d.tag = next_tag_++;
      }
      bench_.run(turn);
    });
  }

  template <class Run>
  void in_turns(std::vector<Descriptor>& all, Run run) {
    for (size_t i = 0; i < all.size() && finding().empty();) {
      const size_t count = std::min<size_t>(random_.within(1, kRing), all.size() - i);
      const uint64_t seed = random_.next();
      bench_.host().memory().start(random_conditions(seed), seed);
      run(std::span(all).subspan(i, count));
      i += count;
      if (finding().empty()) bench_.host().free_all();
    }
  }

  UnitMaker maker_;
  StreamImage image_;
  Random random_;
  ViewBench bench_;
  uint32_t next_tag_ = 0x1000;
};

/// A picture of three macro rows and two columns of squares in blocks of 2, with odd sides.
inline std::vector<uint8_t> large_picture(unsigned block_size) {
  EncodeParams params;
  params.profile = Profile::kMain;
  params.tree_height = 0;
  params.block_size = block_size;
  params.threads = 1;
  const LightFieldShape shape{1, 2, 75 * block_size - 1, 85 * block_size - 1, 8};
  return encode(test::textured_light_field(shape, 1, 8), params)->bytes;
}

/// A picture of the greatest width, in 2048 tiles of blocks of 2; a row of RGB161616 has 98,304
/// bytes.
inline std::vector<uint8_t> wide_picture() {
  EncodeParams params;
  params.profile = Profile::kMain;
  params.tree_height = 0;
  params.block_size = 2;
  params.threads = 1;
  return encode(test::textured_light_field({1, 1, 16384, 32, 8}, 1, 8), params)->bytes;
}

}  // namespace hmlfc::tb
