#include "accuracy/frame_sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <sstream>
#include <string_view>
#include <tuple>
#include <utility>

#include <hmlfc/renderer.hpp>

#include "common/orbit.hpp"
#include "common/program.hpp"
#include "gpu_ref/frame_renderer.hpp"
#include "io/files.hpp"
#include "terminal/clock.hpp"

namespace hmlfc::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kFilters = {Filter::kNearest, Filter::kBilinear, Filter::kQuadrilinear};
constexpr std::array<std::string_view, 3> kBackends = {"cpu", "golden", "gpu"};

// The error of a frame, separated into its causes: mean squared differences over all pixels and R,
// G, B, in samples. Real frames are those of docs/rendering.md, section 7, in double precision; the
// source is the uncompressed light field.
struct FrameErrors {
  double total = 0;   // the frame against the source's real frame of filter quadrilinear
  double stream = 0;  // real frames, quadrilinear: stream at the frame's level against source
  double filter = 0;  // real frames of the source: the frame's filter against quadrilinear
  double fixed = 0;   // the frame against the stream's real frame of its filter and level
  double largest_fixed = 0;  // largest absolute difference of these two
};

double mean_squared_difference(const RealFrame& a, const RealFrame& b) {
  double sum = 0;
  for (size_t i = 0; i < a.samples.size(); ++i) {
    const double difference = a.samples[i] - b.samples[i];
    sum += difference * difference;
  }
  return sum / static_cast<double>(a.samples.size());
}

// Real frames that one camera takes, drawn when needed.
class RealFrames {
 public:
  RealFrames(const Decoder& decoder, const Camera& camera) : decoder_(decoder), camera_(camera) {}

  const RealFrame& of(Filter filter, int stop_level) {
    const auto [found, first] = frames_.try_emplace({filter, stop_level});
    if (first) {
      camera_.filter = filter;
      found->second = value_of(render_real(decoder_, camera_, stop_level));
    }
    return found->second;
  }

 private:
  const Decoder& decoder_;
  Camera camera_;
  std::map<std::pair<Filter, int>, RealFrame> frames_;
};

// Adds the errors of `image`, drawn from the stream with `filter` down to `stop_level`.
void add_errors(const RgbImage& image, Filter filter, int stop_level, RealFrames& stream,
                RealFrames& source, FrameErrors& sum) {
  const RealFrame& best = source.of(Filter::kQuadrilinear, 0);
  const RealFrame& own = stream.of(filter, stop_level);
  sum.total += mean_squared_error(image, best);
  sum.stream += mean_squared_difference(stream.of(Filter::kQuadrilinear, stop_level), best);
  sum.filter += mean_squared_difference(source.of(filter, 0), best);
  sum.fixed += mean_squared_error(image, own);
  for (size_t i = 0; i < own.samples.size(); ++i) {
    sum.largest_fixed = std::max(sum.largest_fixed, std::abs(image.samples[i] - own.samples[i]));
  }
}

struct OpenFile {
  explicit OpenFile(const std::string& path)
      : file(value_of(io::map_file(path))), decoder(value_of(Decoder::open(file.bytes()))) {}

  MappedFile file;
  Decoder decoder;
};

// Throws std::runtime_error: backend gpu without a device.
std::unique_ptr<FrameRenderer> open_backend(const FrameSetting& setting, const Decoder& decoder) {
  RenderOptions options;
  options.cache_bytes = setting.cache_mib << 20;
  if (setting.backend == "cpu") return make_cpu_renderer(decoder, options);
  if (setting.backend == "golden") return make_golden_renderer(decoder);
  return value_of(gpu::make_gpu_renderer(value_of(gpu::Device::open()), decoder, options));
}

// The least value that `share` of the values do not exceed.
double percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values[std::max<size_t>(rank, 1) - 1];
}

class Sweep {
 public:
  explicit Sweep(const FrameSweep& sweep)
      : sweep_(sweep),
        stream_(sweep.stream),
        source_(sweep.source),
        header_(stream_.decoder.header()) {
    const StreamHeader& a = header_;
    const StreamHeader& b = source_.decoder.header();
    if (std::tie(a.rows, a.cols, a.width, a.height, a.depth) !=
        std::tie(b.rows, b.cols, b.width, b.height, b.depth)) {
      throw std::runtime_error("stream and source are light fields of different shapes");
    }
  }

  Json run() {
    Json rows = Json::array();
    for (const FrameSetting& setting : sweep_.settings) rows.push_back(draw(setting));
    compare();
    for (size_t k = 0; k < rows.size(); ++k) {
      if (!rows[k].contains("skipped")) put_errors(sweep_.settings[k], rows[k]);
    }
    return rows;
  }

 private:
  using Kind = std::pair<Filter, int>;  // filter and stop level, all that pixels depend on

  // Closer than where the pixels of a frame and of a view coincide, so that pixels are
  // interpolated; every pixel is inside.
  Camera camera(int frame) const {
    const Camera orbit = orbit_camera(header_, frame, sweep_.frames, sweep_.side);
    Camera camera = with_defaults(orbit, header_);
    *camera.tan_half *= 0.875;
    return camera;
  }

  Kind kind_of(const FrameSetting& setting) const {
    return {setting.filter, header_.tree_height + 1 - setting.levels};
  }

  // Times all frames of a setting.
  Json draw(const FrameSetting& setting) {
    Json row{{"setting", setting.text}};
    // A decoder of its own: key images are decoded again.
    const Decoder decoder = value_of(Decoder::open(stream_.file.bytes()));
    std::unique_ptr<FrameRenderer> renderer;
    try {
      renderer = open_backend(setting, decoder);
    } catch (const std::runtime_error& error) {
      row["skipped"] = error.what();
      return row;
    }
    std::vector<double> seconds;
    std::vector<RgbImage> images;
    FrameCounts counts;
    for (int k = 0; k < sweep_.frames; ++k) {
      Camera taken = camera(k);
      taken.filter = setting.filter;
      const FrameRecord record = value_of(frame_record(taken, header_));
      Frame frame;
      const Clock clock;
      const auto drawn = renderer->render(record, kind_of(setting).second, frame);
      seconds.push_back(clock.cpu_seconds());
      value_of(drawn);
      counts.blocks_needed += frame.counts.blocks_needed;
      counts.blocks_decoded += frame.counts.blocks_decoded;
      images.push_back(std::move(frame.image));
    }
    keep(setting, std::move(images));
    row["cpu_ms.median"] = percentile(seconds, 0.5) * 1e3;
    row["cpu_ms.p95"] = percentile(seconds, 0.95) * 1e3;
    row["blocks_needed"] = counts.blocks_needed / static_cast<uint64_t>(sweep_.frames);
    row["blocks_decoded"] = counts.blocks_decoded / static_cast<uint64_t>(sweep_.frames);
    return row;
  }

  // The first setting of a kind leaves its pictures, which those of the others must equal.
  void keep(const FrameSetting& setting, std::vector<RgbImage> images) {
    const auto [found, first] = images_.try_emplace(kind_of(setting), std::move(images));
    if (!first &&
        !std::ranges::equal(images, found->second, {}, &RgbImage::samples, &RgbImage::samples)) {
      throw std::runtime_error(setting.text +
                               ": the frames differ from those of another setting with this filter "
                               "and level");
    }
  }

  // Camera by camera, so that the real frames of one camera alone are held.
  void compare() {
    for (int k = 0; k < sweep_.frames; ++k) {
      RealFrames stream(stream_.decoder, camera(k));
      RealFrames source(source_.decoder, camera(k));
      for (const auto& [kind, images] : images_) {
        const auto& image = images[static_cast<size_t>(k)];
        add_errors(image, kind.first, kind.second, stream, source, errors_[kind]);
      }
    }
  }

  void put_errors(const FrameSetting& setting, Json& row) const {
    const FrameErrors& errors = errors_.at(kind_of(setting));
    const auto frames = static_cast<double>(sweep_.frames);
    row["mse.total"] = errors.total / frames;
    row["mse.stream"] = errors.stream / frames;
    row["mse.filter"] = errors.filter / frames;
    row["mse.fixed"] = errors.fixed / frames;
    row["largest_fixed"] = errors.largest_fixed;
    if (setting.filter == Filter::kQuadrilinear) {
      row["bound_fixed"] = fixed_point_bound(camera(0), header_);
    }
  }

  const FrameSweep& sweep_;
  OpenFile stream_;
  OpenFile source_;
  const StreamHeader& header_;
  std::map<Kind, std::vector<RgbImage>> images_;
  std::map<Kind, FrameErrors> errors_;
};

}  // namespace

FrameSetting parse_frame_setting(const std::string& text) {
  FrameSetting setting;
  setting.text = text;
  std::string filter;
  std::istringstream parts(text);
  char colon = 0;
  std::getline(parts, filter, ':');
  parts >> setting.levels >> colon >> setting.cache_mib >> colon >> setting.backend;
  const auto known = std::ranges::find(kFilters, filter, filter_name);
  const auto backend = std::ranges::find(kBackends, setting.backend);
  if (parts.fail() || known == kFilters.end() || backend == kBackends.end()) {
    throw std::invalid_argument(text + ": not FILTER:LEVELS:CACHE:BACKEND");
  }
  setting.filter = *known;
  return setting;
}

nlohmann::ordered_json sweep_frames(const FrameSweep& sweep) { return Sweep(sweep).run(); }

}  // namespace hmlfc::bench
