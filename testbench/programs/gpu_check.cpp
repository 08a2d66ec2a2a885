// gpu-check: every block of a stream, or a part of them, through the GPU decoder and the golden
// model.
#include "decoder/open_stream.hpp"
#include "gpu/frame_check.hpp"
#include "gpu/gpu_answers.hpp"
#include "gpu/stream_check.hpp"
#include "oracle/oracle.hpp"
#include "oracle/trace_text.hpp"
#include "programs/commands.hpp"
#include "programs/plan_options.hpp"
#include "terminal/numbers.hpp"
#include "terminal/progress_bar.hpp"

namespace hmlfc::gpu {
namespace {

using tb::Stop;

struct Options {
  std::string file;
  tb::PlanOptions plan;
  std::vector<uint32_t> block;
  DeviceOptions device;
  bool list = false;
  bool json = false;
  bool answers_only = false;
  uint64_t frames = 0;
  uint32_t cache_mib = 256;
  std::string size;
  Camera camera;
};

void add_options(CLI::App& app, Options& o) {
  app.add_option("file", o.file, "The stream");
  o.plan.add_to(app);
  app.add_option("--block", o.block,
                 "Print the stages of one block instead: ROW COL PLANE BX BY [STOP]")
      ->expected(5, 6);
  app.add_option("--frames", o.frames,
                 "Render so many novel views instead, from the first column to the last");
  app.add_option("--size", o.size, "Pixels of a frame, WxH (default: those of a view)");
  app.add_option("--cache", o.cache_mib, "MiB of decoded blocks kept between frames")
      ->check(CLI::Range(0u, 1u << 20))
      ->capture_default_str();
  app.add_option("--device", o.device.device, "Number or part of the name of a Vulkan device");
  app.add_flag("--list-devices", o.list, "List the Vulkan devices");
  app.add_option("--chunk-bytes", o.device.chunk_bytes,
                 "Largest buffer of stream and reference area, a power of two");
  app.add_flag("--validation", o.device.validation, "Run under the Vulkan validation layer");
  app.add_flag("--answers-only", o.answers_only, "Do not compare the stages");
  app.add_flag("--json", o.json, "Print JSON");
}

std::string replay_command(const Options& o) {
  std::string text = fmt::format("./run gpu-check {} {}", o.file, o.plan.replay());
  if (!o.device.device.empty()) text += fmt::format(" --device \"{}\"", o.device.device);
  if (o.device.chunk_bytes != 0) text += fmt::format(" --chunk-bytes {}", o.device.chunk_bytes);
  if (o.answers_only) text += " --answers-only";
  return text;
}

int list() {
  const auto devices = list_devices();
  if (!devices) throw Stop{devices.error().message};
  for (size_t i = 0; i < devices->size(); ++i) {
    const DeviceInfo& info = (*devices)[i];
    fmt::print("{}: {} ({}), driver {}{}\n", i, info.name, info.kind, info.driver,
               info.missing.empty() ? "" : ", cannot run the decoder: no " + info.missing);
  }
  return 0;
}

// The number of requests of the run, for its progress.
uint64_t request_count(const Options& o, const tb::GoldenStream& stream) {
  if (o.plan.mixed != 0) return o.plan.mixed;
  const tb::ScanPlan& plan = o.plan.plan;
  const StreamHeader& header = stream.header();
  const Plane plane = plan.plane == tb::kRgb ? Plane::kY : static_cast<Plane>(plan.plane);
  const PlaneShape& shape = stream.geometry().plane(plane);
  const uint64_t views = std::min(plan.views, uint64_t{header.rows} * header.cols);
  const auto blocks = static_cast<double>(views * shape.blocks_x * shape.blocks_y);
  return static_cast<uint64_t>(blocks * plan.fraction);
}

// Prints the model's and the device's stages of one block; whether both are equal.
int show_block(const Options& o, const tb::GoldenStream& stream, GpuDecoder& decoder) {
  tb::Request request{o.block[0], o.block[1], o.block[3], o.block[4], o.block[2]};
  if (o.block.size() == 6) request.stop_level = o.block[5];
  if (request.plane > 2) throw Stop{"--block takes plane 0, 1 or 2"};
  const auto traces = gpu_traces(decoder, std::span(&request, 1));
  if (!traces) throw Stop{traces.error().message};
  const auto expected = tb::Oracle(stream).evaluate(request);
  const unsigned size = stream.geometry().block_size();
  fmt::print("model: {}\n", tb::status_name(expected.answer.status));
  std::fflush(stdout);
  tb::write_expected(stdout, expected, size);
  const GpuTrace& trace = traces->front();
  fmt::print("device: {}\n", tb::status_name(trace.status));
  std::fflush(stdout);
  for (size_t i = 0; i < trace.levels.size(); ++i) {
    tb::LevelRecord record = trace.levels[i];
    if (expected.planes[0]) record.site = expected.planes[0]->levels[i].site;
    tb::write_record(stdout, record, size);
  }
  return expected.answer.status == trace.status ? 0 : tb::kExitDifferent;
}

int check(const Options& o, const tb::GoldenStream& stream, Device& device, GpuDecoder& decoder) {
  const uint64_t total = request_count(o, stream);
  terminal::ProgressBar bar("Checking", "blocks");
  CheckOptions options;
  options.stages = !o.answers_only;
  options.progress = [&](uint64_t done) { bar.update(std::min(done, total), total); };
  const auto requests = o.plan.requests(stream.geometry(), stream.header());
  const auto result = check_stream(decoder, stream, requests, options);
  bar.clear();
  if (!result) throw Stop{result.error().message};
  const CheckCounts& counts = result->counts;
  const bool passed = !result->mismatch && counts.compared == counts.sent && counts.compared != 0 &&
                      device.validation_messages().empty();
  nlohmann::ordered_json report{{"file", o.file},
                                {"device", device.info().name},
                                {"seed", o.plan.plan.seed},
                                {"replay", replay_command(o)},
                                {"passed", passed},
                                {"sent", counts.sent},
                                {"compared", counts.compared},
                                {"failed", counts.failed()},
                                {"levels_compared", counts.levels},
                                {"validation_messages", device.validation_messages()}};
  if (result->mismatch) report["mismatch"] = to_string(*result->mismatch);
  return tb::print_report(report, o.json);
}

int show_frames(const Options& o, std::span<const uint8_t> file, const StreamView& view,
                Device& device) {
  auto renderer = GpuRenderer::open(device, view, uint64_t{o.cache_mib} << 20);
  if (!renderer) throw Stop{renderer.error().message};
  const auto checked = check_frames(*renderer, file, view, o.camera, o.frames);
  if (!checked) throw Stop{checked.error().message};
  fmt::print("{}: {} frames, {} blocks needed, {} decoded\n", device.info().name, checked->frames,
             checked->needed, checked->decoded);
  if (checked->mismatch) fmt::print("MISMATCH: {}\n", *checked->mismatch);
  fmt::print("{}\n", checked->mismatch ? "FAILED" : "equal to the golden renderer");
  return checked->mismatch ? tb::kExitDifferent : 0;
}

int run_on_stream(const Options& o) {
  const MappedFile file = tb::read_file(o.file);
  OpenOptions open_options;
  open_options.check_sections = false;  // damaged streams are checked too
  const auto view = open_stream(file.bytes(), open_options);
  if (!view) throw Stop{o.file + ": " + to_string(view.error())};
  const auto stream = tb::GoldenStream::open(file.bytes(), {view->header.block_log2, 12, 16, 16});
  if (!stream) throw Stop{o.file + ": " + to_string(stream.error())};
  auto device = Device::open(o.device);
  if (!device) throw Stop{device.error().message};
  if (o.frames != 0) return show_frames(o, file.bytes(), *view, *device);
  auto decoder = GpuDecoder::open(*device, *view);
  if (!decoder) throw Stop{decoder.error().message};
  if (!o.block.empty()) return show_block(o, **stream, *decoder);
  return tb::with_replay(o.plan.plan.seed, replay_command(o),
                         [&] { return check(o, **stream, *device, *decoder); });
}

int run(Options& o) {
  if (o.list) return list();
  if (o.file.empty()) throw Stop{"which stream? See --help"};
  o.plan.apply();
  if (!o.size.empty()) {
    const auto size = terminal::parse_numbers<2>(o.size, 'x');
    if (!size) throw Stop{"--size is WxH, such as 512x512"};
    o.camera.frame_width = (*size)[0];
    o.camera.frame_height = (*size)[1];
  }
  return run_on_stream(o);
}

int run(int argc, char** argv) {
  CLI::App app{"Checks the GPU decoder's blocks of a stream against the golden model"};
  Options o;
  add_options(app, o);
  CLI11_PARSE(app, argc, argv);
  try {
    return run(o);
  } catch (const Stop& stop) {
    fmt::print(stderr, "gpu-check: {}\n", stop.message);
    return stop.exit_code;
  }
}

}  // namespace
}  // namespace hmlfc::gpu

int main(int argc, char** argv) { return hmlfc::gpu::run(argc, argv); }
