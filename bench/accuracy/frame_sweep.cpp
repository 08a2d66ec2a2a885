#include "accuracy/frame_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "accuracy/frame_errors.hpp"
#include "gpu_ref/frame_renderer.hpp"
#include "io/mapped_file.hpp"
#include "render/orbit.hpp"
#include "render/timing.hpp"

namespace hmlfc::bench {
namespace {

using Json = nlohmann::ordered_json;
using Failure = tl::unexpected<std::string>;

struct OpenFile {
  io::MappedFile file;
  Decoder decoder;
};

tl::expected<OpenFile, std::string> open(const std::filesystem::path& path) {
  auto file = io::MappedFile::open(path);
  if (!file) return Failure(file.error().message);
  auto decoder = Decoder::open(file->bytes());
  if (!decoder) return Failure(path.string() + ": " + to_string(decoder.error()));
  return OpenFile{std::move(*file), std::move(*decoder)};
}

// The renderer of `setting` for the stream of `decoder`, which must outlive it. Errors: backend gpu
// without a device.
tl::expected<std::unique_ptr<FrameRenderer>, std::string> open_backend(const FrameSetting& setting,
                                                                       const Decoder& decoder) {
  RenderOptions options;
  options.cache_bytes = setting.cache_mib << 20;
  if (setting.backend == Backend::kCpu) return make_cpu_renderer(decoder, options);
  if (setting.backend == Backend::kGolden) return make_golden_renderer(decoder);
  auto device = gpu::Device::open();
  if (!device) return Failure(device.error().message);
  auto renderer = gpu::make_gpu_renderer(std::move(*device), decoder, options);
  if (!renderer) return Failure(renderer.error().message);
  return std::move(*renderer);
}

// The smallest value that `share` of the values do not exceed.
double percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values[std::max<size_t>(rank, 1) - 1];
}

class Sweep {
 public:
  Sweep(const FrameSweep& sweep, const OpenFile& stream, const OpenFile& source)
      : sweep_(sweep), stream_(stream), source_(source), header_(stream.decoder.header()) {}

  tl::expected<Json, std::string> run() {
    Json rows = Json::array();
    for (const FrameSetting& setting : sweep_.settings) {
      auto row = draw(setting);
      if (!row) return Failure(setting.text + ": " + row.error());
      rows.push_back(std::move(*row));
    }
    const auto compared = compare();
    if (!compared) return Failure(compared.error());
    for (size_t k = 0; k < rows.size(); ++k) {
      if (!rows[k].contains("skipped")) add_errors(sweep_.settings[k], rows[k]);
    }
    return rows;
  }

 private:
  using Kind = std::pair<Filter, int>;  // filter and stop level: all that pixels depend on

  // A little closer than where pixels of frame and view coincide, so that pixels are interpolated;
  // every pixel is inside.
  Camera camera(int frame) const {
    const Camera orbit = orbit_camera(header_, frame, sweep_.frames, sweep_.side);
    Camera camera = with_defaults(orbit, header_);
    *camera.tan_half *= 0.875;
    return camera;
  }

  Kind kind_of(const FrameSetting& setting) const {
    return {setting.filter, header_.tree_height + 1 - setting.levels};
  }

  // Times all frames of a setting. Settings of the same kind must give the same pictures.
  tl::expected<Json, std::string> draw(const FrameSetting& setting) {
    const auto [filter, stop_level] = kind_of(setting);
    if (stop_level < 0) return Failure("the stream has fewer levels");
    Json row{{"setting", setting.text}};
    // A new decoder, which has not decoded any key image.
    const auto decoder = Decoder::open(stream_.file.bytes());
    const auto renderer = open_backend(setting, *decoder);
    if (!renderer) {
      row["skipped"] = renderer.error();
      return row;
    }
    std::vector<double> seconds;
    std::vector<RgbImage> images;
    FrameCounts counts;
    for (int k = 0; k < sweep_.frames; ++k) {
      Camera taken = camera(k);
      taken.filter = filter;
      const auto record = frame_record(taken, header_);
      if (!record) return Failure(record.error().message);
      Frame frame;
      const Clock clock;
      const auto drawn = (*renderer)->render(*record, stop_level, frame);
      seconds.push_back(clock.cpu_seconds());
      if (!drawn) return Failure(to_string(drawn.error()));
      counts.blocks_needed += frame.counts.blocks_needed;
      counts.blocks_decoded += frame.counts.blocks_decoded;
      images.push_back(std::move(frame.image));
    }
    row["cpu_ms.median"] = percentile(seconds, 0.5) * 1e3;
    row["cpu_ms.p95"] = percentile(seconds, 0.95) * 1e3;
    row["blocks_needed"] = counts.blocks_needed / static_cast<uint64_t>(sweep_.frames);
    row["blocks_decoded"] = counts.blocks_decoded / static_cast<uint64_t>(sweep_.frames);
    if (!keep(kind_of(setting), std::move(images))) {
      return Failure("the frames differ from those of another setting with this filter and level");
    }
    return row;
  }

  bool keep(const Kind& kind, std::vector<RgbImage> images) {
    const auto [found, first] = images_.try_emplace(kind, images);
    if (first) return true;
    for (size_t k = 0; k < images.size(); ++k) {
      if (images[k].samples != found->second[k].samples) return false;
    }
    return true;
  }

  // Camera by camera, so that only the real frames of one camera are in memory.
  tl::expected<void, std::string> compare() {
    for (int k = 0; k < sweep_.frames; ++k) {
      FrameComparison comparison(stream_.decoder, source_.decoder, camera(k));
      for (const auto& [kind, images] : images_) {
        const auto errors =
            comparison.errors(images[static_cast<size_t>(k)], kind.first, kind.second);
        if (!errors) return Failure(to_string(errors.error()));
        errors_[kind].add(*errors);
      }
    }
    return {};
  }

  void add_errors(const FrameSetting& setting, Json& row) const {
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
  const OpenFile& stream_;
  const OpenFile& source_;
  const StreamHeader& header_;
  std::map<Kind, std::vector<RgbImage>> images_;
  std::map<Kind, FrameErrors> errors_;
};

}  // namespace

tl::expected<nlohmann::ordered_json, std::string> sweep_frames(const FrameSweep& sweep) {
  const auto stream = open(sweep.stream);
  if (!stream) return Failure(stream.error());
  const auto source = open(sweep.source);
  if (!source) return Failure(source.error());
  const StreamHeader& a = stream->decoder.header();
  const StreamHeader& b = source->decoder.header();
  if (std::tie(a.rows, a.cols, a.width, a.height, a.depth) !=
      std::tie(b.rows, b.cols, b.width, b.height, b.depth)) {
    return Failure("stream and source are light fields of different shapes");
  }
  return Sweep(sweep, *stream, *source).run();
}

}  // namespace hmlfc::bench
