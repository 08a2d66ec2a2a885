// view: a rectangle of a view through descriptor and DMA, every byte compared with the golden
// model.
#include <algorithm>
#include <string>
#include <vector>

#include "io/image_files.hpp"
#include "programs/commands.hpp"
#include "stimulus/sequences.hpp"
#include "syntax/header.hpp"
#include "systemc/stream_image.hpp"
#include "unit/units.hpp"
#include "view/view_bench.hpp"
#include "view/view_pictures.hpp"

namespace hmlfc::tb {
namespace {

constexpr int kExitOutput = 74;
constexpr uint32_t kTag = 0x77656976;

struct Options {
  std::string file;
  std::vector<uint32_t> view{0, 0};
  std::string format = "rgb888";
  unsigned stop_level = 0;
  std::vector<uint32_t> rectangle;
  std::string output;
  uint64_t seed = 0;
  bool random_conditions = false;
};

ViewFormat format_of(const std::string& name) {
  const auto found = std::ranges::find(kViewFormatNames, name);
  return static_cast<ViewFormat>(found - kViewFormatNames.begin());
}

Descriptor descriptor_of(const Options& o, const Geometry& geometry) {
  Descriptor d{.tag = kTag, .row = o.view[0], .col = o.view[1], .stop_level = o.stop_level};
  d.format = format_of(o.format);
  const PlaneShape& plane =
      geometry.plane(d.format <= ViewFormat::kCg ? static_cast<Plane>(d.format) : Plane::kY);
  d.width = plane.width;
  d.height = plane.height;
  if (!o.rectangle.empty()) {
    d.x = o.rectangle[0];
    d.y = o.rectangle[1];
    d.width = o.rectangle[2];
    d.height = o.rectangle[3];
  }
  return d;
}

int decode(const Options& o, std::span<const uint8_t> file, const StreamHeader& header,
           const UnitMaker& maker) {
  StreamImage image(file, maker.parameters);
  if (image.golden() == nullptr) throw Stop{status_name(image.load_error())};
  Descriptor d = descriptor_of(o, image.golden()->geometry());
  if (d.width == 0 || d.height == 0) throw Stop{"the rectangle is empty"};
  ViewBench bench(maker.make(maker.parameters.with_state(o.seed), nullptr), file,
                  image.area().bytes, image.oracle());
  ViewHost& host = bench.host();
  if (o.random_conditions) host.memory().start(random_conditions(o.seed), o.seed);
  bench.fill_area();
  fmt::print("reference area of {} bytes, filled in {} clocks\n", host.area().size(),
             host.clocks());
  host.allocate(d, 0, true);
  const uint64_t begin = host.clocks();
  const uint64_t read = host.memory().bytes_read;
  const uint64_t written = host.memory().bytes_written;
  const uint64_t beats = host.memory().write_beats;
  bench.run(std::span(&d, 1));
  const auto clocks = static_cast<double>(host.clocks() - begin);
  const double pixels = static_cast<double>(d.width) * d.height;
  const ViewStatus status = bench.last_status();
  fmt::print("clocks {:.0f}, {:.2f} a pixel\n", clocks, clocks / pixels);
  fmt::print("bytes read {}, {:.2f} a pixel\n", host.memory().bytes_read - read,
             static_cast<double>(host.memory().bytes_read - read) / pixels);
  fmt::print("bytes written {}, in {} beats of {}\n", host.memory().bytes_written - written,
             host.memory().write_beats - beats, maker.parameters.beat_bytes);
  fmt::print("status {}, blocks with errors {}\n", static_cast<unsigned>(status.result),
             status.block_errors);
  if (!o.output.empty() && d.format >= ViewFormat::kRgb888) {
    const auto saved = io::write_ppm(o.output, read_pixels(d, host.memory().content, header.depth));
    if (!saved) throw Stop{saved.error().message, kExitOutput};
  }
  fmt::print("{}\n", bench.finding().empty() ? "equal to the model" : "FAILED: " + bench.finding());
  return bench.finding().empty() ? 0 : kExitDifferent;
}

int run(const Options& o) {
  const MappedFile file = read_file(o.file);
  const auto header = parse_header(file.bytes());
  if (!header) throw Stop{"the stream's header is damaged"};
  const auto makers = view_units();
  const UnitMaker* maker = unit_for(makers, header->block_log2, header->depth);
  if (maker == nullptr) throw Stop{"this build has no view unit for the stream"};
  return decode(o, file.bytes(), *header, *maker);
}

}  // namespace

Command add_view(CLI::App& app) {
  auto options = std::make_shared<Options>();
  Options& o = *options;
  app.add_option("FILE", o.file, "The stream")->required();
  app.add_option("--view", o.view, "Row and column")->delimiter(',')->expected(2);
  app.add_option("--format", o.format, "Of the pixels, or a plane")
      ->check(CLI::IsMember({"y", "co", "cg", "rgb888", "rgb101010", "rgb161616"}))
      ->capture_default_str();
  app.add_option("--stop-level", o.stop_level, "0 for views")->check(CLI::Range(0, 15));
  app.add_option("--rectangle", o.rectangle, "X,Y,WIDTH,HEIGHT; X and Y are multiples of B")
      ->delimiter(',')
      ->expected(4);
  app.add_option("--out", o.output, "A PPM of what was written, for RGB");
  app.add_flag("--random-conditions", o.random_conditions, "Latencies and stalls by the seed");
  app.add_option("--seed", o.seed)->capture_default_str();
  return [options] { return run(*options); };
}

}  // namespace hmlfc::tb
