// Time and error of decoding and of frames, for settings of the renderers.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <tuple>
#include <vector>

#include <hmlfc/renderer.hpp>

#include "common/measuring.hpp"
#include "subcommands.hpp"
#include "terminal/clock.hpp"

namespace hmlfc::bench {
namespace {

// How frames are drawn.
struct Setting {
  std::string text;  // as it was given
  Filter filter = Filter::kQuadrilinear;
  int stop_level = 0;
  size_t cache_bytes = 0;
};

// The setting of FILTER:LEVELS:CACHE, such as "views:4:256".
Setting parse(const std::string& text, const StreamHeader& header) {
  Setting setting;
  setting.text = text;
  std::string filter;
  std::istringstream parts(text);
  char colon = 0;
  int levels = 0;
  std::getline(parts, filter, ':');
  parts >> levels >> colon >> setting.cache_bytes;
  for (const Filter value : {Filter::kNearest, Filter::kViews, Filter::kQuadrilinear}) {
    if (filter != filter_name(value) || parts.fail()) continue;
    setting.filter = value;
    setting.stop_level = header.tree_height + 1 - levels;
    setting.cache_bytes <<= 20;
    return setting;
  }
  throw std::invalid_argument(text + ": not FILTER:LEVELS:CACHE");
}

double mean_squared_difference(const RealFrame& a, const RealFrame& b) {
  double sum = 0;
  for (size_t i = 0; i < a.samples.size(); ++i) {
    const double difference = a.samples[i] - b.samples[i];
    sum += difference * difference;
  }
  return sum / static_cast<double>(a.samples.size());
}

// The error of frames, separated into its causes: mean squared differences over all pixels and R,
// G, B, in samples. Real frames are those of docs/rendering.md, section 7, in double precision; the
// source is the uncompressed light field.
struct Errors {
  double total = 0;   // the frame against the source's real frame of filter quadrilinear
  double stream = 0;  // real frames, quadrilinear: stream at the frame's level against source
  double filter = 0;  // real frames of the source: the frame's filter against quadrilinear
  double fixed = 0;   // the frame against the stream's real frame of its filter and level
  double largest_fixed = 0;  // largest absolute difference of these two
};

class Sweep {
 public:
  // Throws std::runtime_error: light fields of different shapes.
  Sweep(const Decoder& stream, const Decoder& source, int frames, uint32_t side)
      : stream_(stream), source_(source), frames_(frames), side_(side) {
    const StreamHeader& a = stream.header();
    const StreamHeader& b = source.header();
    if (std::tie(a.rows, a.cols, a.width, a.height, a.depth) !=
        std::tie(b.rows, b.cols, b.width, b.height, b.depth)) {
      throw std::runtime_error("stream and source are light fields of different shapes");
    }
  }

  // Draws and times all frames of a setting. decoder: one of its own, so that key images are
  // decoded again. Throws std::runtime_error where frames differ from those of another setting with
  // this filter and level.
  Json draw(const Setting& setting, const Decoder& decoder, FrameRenderer& renderer) {
    std::vector<double> seconds;
    std::vector<RgbImage> images;
    FrameCounts counts;
    for (int k = 0; k < frames_; ++k) {
      const FrameRecord record =
          value_of(frame_record(camera(k, setting.filter), decoder.header()));
      Frame frame;
      const Clock clock;
      const auto drawn = renderer.render(record, setting.stop_level, frame);
      seconds.push_back(clock.cpu_seconds());
      value_of(drawn);
      counts.blocks_needed += frame.counts.blocks_needed;
      counts.blocks_decoded += frame.counts.blocks_decoded;
      images.push_back(std::move(frame.image));
    }
    std::ranges::sort(seconds);
    const auto rank = [&](double share) {
      return seconds[static_cast<size_t>(std::ceil(share * frames_)) - 1];
    };
    Json row{{"frame", setting.text},
             {"median_cpu_seconds", rank(0.5)},
             {"p95_cpu_seconds", rank(0.95)},
             {"blocks_needed", counts.blocks_needed / static_cast<uint64_t>(frames_)},
             {"blocks_decoded", counts.blocks_decoded / static_cast<uint64_t>(frames_)}};
    put_errors(setting, images, row);
    return row;
  }

 private:
  // Closer than where the pixels of a frame and of a view coincide, so that pixels are
  // interpolated; every pixel is inside.
  Camera camera(int frame, Filter filter) const {
    Camera camera =
        with_defaults(orbit_camera(stream_.header(), frame, frames_, side_), stream_.header());
    *camera.tan_half *= 0.875;
    camera.filter = filter;
    return camera;
  }

  // All that pixels depend on is the filter and the level: what was measured is measured once.
  void put_errors(const Setting& setting, const std::vector<RgbImage>& images, Json& row) {
    auto& [first, errors] = known_[{setting.filter, setting.stop_level}];
    if (first.empty()) {
      first = images;
      errors = errors_of(setting, images);
    } else if (!std::ranges::equal(images, first, {}, &RgbImage::samples, &RgbImage::samples)) {
      throw std::runtime_error(
          setting.text +
          ": the frames differ from those of another setting with this filter and level");
    }
    row["mse_total"] = errors.total / frames_;
    row["mse_stream"] = errors.stream / frames_;
    row["mse_filter"] = errors.filter / frames_;
    row["mse_fixed"] = errors.fixed / frames_;
    row["largest_fixed"] = errors.largest_fixed;
    if (setting.filter == Filter::kQuadrilinear) {
      row["bound_fixed"] = fixed_point_bound(camera(0, setting.filter), stream_.header());
    }
  }

  // The sum over all frames.
  Errors errors_of(const Setting& setting, const std::vector<RgbImage>& images) const {
    Errors sum;
    for (int k = 0; k < frames_; ++k) {
      const RgbImage& image = images[static_cast<size_t>(k)];
      const auto real = [&](const Decoder& decoder, Filter filter, int stop_level) {
        return value_of(render_real(decoder, camera(k, filter), stop_level));
      };
      const RealFrame best = real(source_, Filter::kQuadrilinear, 0);
      const RealFrame own = real(stream_, setting.filter, setting.stop_level);
      const bool quadrilinear = setting.filter == Filter::kQuadrilinear;
      sum.total += mean_squared_error(image, best);
      sum.stream += mean_squared_difference(
          quadrilinear ? own : real(stream_, Filter::kQuadrilinear, setting.stop_level), best);
      if (!quadrilinear)
        sum.filter += mean_squared_difference(real(source_, setting.filter, 0), best);
      sum.fixed += mean_squared_error(image, own);
      for (size_t i = 0; i < own.samples.size(); ++i) {
        sum.largest_fixed =
            std::max(sum.largest_fixed, std::abs(image.samples[i] - own.samples[i]));
      }
    }
    return sum;
  }

  const Decoder& stream_;
  const Decoder& source_;
  int frames_;
  uint32_t side_;
  std::map<std::pair<Filter, int>, std::pair<std::vector<RgbImage>, Errors>> known_;
};

}  // namespace

Json frames(Arguments arguments) {
  const auto file = value_of(io::map_file(arguments[0]));
  const auto source_file = value_of(io::map_file(arguments[1]));
  const Decoder stream = value_of(Decoder::open(file.bytes()));
  const Decoder source = value_of(Decoder::open(source_file.bytes()));
  Sweep sweep(stream, source, std::max(std::stoi(arguments[2]), 1),
              static_cast<uint32_t>(std::stoi(arguments[3])));
  Json rows = Json::array();
  for (const std::string& text : arguments.subspan(4)) {
    const Setting setting = parse(text, stream.header());
    const Decoder decoder = value_of(Decoder::open(file.bytes()));
    RenderOptions options;
    options.cache_bytes = setting.cache_bytes;
    rows.push_back(sweep.draw(setting, decoder, *make_cpu_renderer(decoder, options)));
  }
  return rows;
}

Json decode(Arguments arguments) {
  const auto file = value_of(io::map_file(arguments[0]));
  double least = INFINITY;
  std::optional<Decoder> decoder;
  for (int run = 0; run < std::max(std::stoi(arguments[1]), 1); ++run) {
    const Clock clock;
    decoder = value_of(Decoder::open(file.bytes()));
    value_of(decoder->decode_all([](ViewPos, RgbImage&&) {}));
    least = std::min(least, clock.cpu_seconds());
  }
  return {{"cpu_seconds", least}, {"reference_bytes", decoder->reference_bytes()}};
}

}  // namespace hmlfc::bench
