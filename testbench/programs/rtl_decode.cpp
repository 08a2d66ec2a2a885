// rtl_decode: all views of a stream by the Verilated decode unit, block by block, or by the view
// unit with its driver; a decoder for `hmlfc conform`.
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "conform/output_views.hpp"
#include "conform/stage_trace.hpp"
#include "io/files.hpp"
#include "syntax/header.hpp"
#include "systemc/stream_image.hpp"
#include "unit/pin_record.hpp"
#include "unit/unit_host.hpp"
#include "unit/units.hpp"
#include "vectors/digest.hpp"
#include "view/view_pictures.hpp"
#include "view/view_pin_record.hpp"
#include "view/view_units.hpp"

namespace hmlfc::tb {
namespace {

constexpr int kExitUsage = 2;
constexpr int kExitRefused = 4;
constexpr int kExitInternal = 70;
constexpr int kExitOutput = 74;
constexpr int kExitSkipped = 77;
// Of the memory, while a view unit's pins are recorded.
constexpr Conditions kPauses{
    .latency_jitter = 40, .stall = 250, .address_stall = 250, .backpressure = 250};

// Ends the program with a message.
struct Stop {
  int exit_code;
  std::string message;
};

struct Options {
  std::filesystem::path file;
  std::filesystem::path folder;
  std::string trace;
  std::string pins;
  bool views = false;
};

[[noreturn]] void refuse(unsigned status) { throw Stop{kExitRefused, status_name(status)}; }

// The unit that takes a stream; for a stream without a sound header any unit must refuse it.
const UnitMaker& maker_for(const std::vector<UnitMaker>& makers, std::span<const uint8_t> stream) {
  if (makers.empty()) throw Stop{kExitSkipped, "this build has no Verilated unit"};
  const auto header = parse_header(stream);
  if (!header) return makers.front();
  const UnitMaker* maker = unit_for(makers, header->block_log2, header->depth);
  return maker != nullptr ? *maker : makers.front();
}

// All blocks of `plane`, or of plane Y for kRgb, of a view, row by row.
std::vector<Request> view_requests(const Geometry& geometry, ViewPos view, unsigned plane) {
  const PlaneShape& shape = geometry.plane(plane == kRgb ? Plane::kY : static_cast<Plane>(plane));
  std::vector<Request> requests;
  for (uint32_t by = 0; by < shape.blocks_y; ++by) {
    for (uint32_t bx = 0; bx < shape.blocks_x; ++bx) {
      requests.push_back({.row = view.row, .col = view.col, .bx = bx, .by = by, .plane = plane});
    }
  }
  return requests;
}

// Refuses a view in which a block failed with `status`. Requests for RGB go through all planes
// block by block; the error of a view is that of the planes in turn (DEC-7).
[[noreturn]] void refuse_view(UnitHost& unit, const Geometry& geometry, ViewPos view,
                              unsigned status) {
  for (unsigned plane = 0; plane < kRgb; ++plane) {
    for (const Answer& answer : unit.answers(view_requests(geometry, view, plane))) {
      if (answer.status != 0) refuse(answer.status);
    }
  }
  refuse(status);
}

// Three lanes of B x B samples become pixels; those outside the view have no meaning.
void place(const Request& request, const Answer& answer, unsigned b, RgbImage& image) {
  for (uint32_t i = 0; i < b * b; ++i) {
    const uint32_t x = request.bx * b + i % b;
    const uint32_t y = request.by * b + i / b;
    if (x >= image.width || y >= image.height) continue;
    for (size_t lane = 0; lane < kLanes; ++lane) {
      image.samples[(size_t{y} * image.width + x) * 3 + lane] =
          static_cast<uint16_t>(answer.samples[lane * b * b + i]);
    }
  }
}

// Writes all views, each by `picture_of(view)`.
template <class PictureOf>
void write_views(uint32_t rows, uint32_t cols, const std::filesystem::path& folder,
                 const PictureOf& picture_of) {
  auto raw = io::AtomicFile::create(folder / conform::kRawViewsName);
  if (!raw) throw Stop{kExitOutput, raw.error().message};
  for (uint32_t view = 0; view < rows * cols; ++view) {
    const RgbImage image = picture_of(ViewPos{view / cols, view % cols});
    if (const auto done = raw->write(vectors::picture_bytes(image)); !done) {
      throw Stop{kExitOutput, done.error().message};
    }
  }
  if (const auto done = raw->commit(); !done) throw Stop{kExitOutput, done.error().message};
}

RgbImage decode(UnitHost& unit, const GoldenStream& stream, ViewPos view) {
  const StreamHeader& header = stream.header();
  const auto requests = view_requests(stream.geometry(), view, kRgb);
  const auto answers = unit.answers(requests);
  RgbImage image{header.width, header.height, header.depth, {}};
  image.samples.resize(size_t{image.width} * image.height * 3);
  for (size_t i = 0; i < requests.size(); ++i) {
    if (answers[i].status != 0) refuse_view(unit, stream.geometry(), view, answers[i].status);
    place(requests[i], answers[i], header.block_size(), image);
  }
  return image;
}

// The driver checks the stream and fills the reference area; the golden model has no part in it.
void run_views(const Options& options, std::span<const uint8_t> file) {
  const auto makers = view_units();
  if (makers.empty()) throw Stop{kExitSkipped, "this build has no view unit"};
  const auto header = parse_header(file);
  const ViewMaker* maker =
      header ? view_unit_for(makers, header->block_log2, header->depth) : &makers.front();
  if (maker == nullptr) maker = &makers.front();
  Oracle unused(0);
  std::ofstream pins;
  ViewHost::OnClock on_clock;
  if (!options.pins.empty()) {
    pins.open(options.pins);
    on_clock = [&](const ViewInputs& in, const ViewOutputs& out) {
      write_pins(in, out, maker->parameters.beat_bytes, pins);
    };
  }
  ViewHost host(maker->make(maker->parameters, unused, 0), file, 4, on_clock);
  if (!options.pins.empty()) host.set_conditions(kPauses, 1);
  hmlfc_error error = host.stream_error();
  if (error.code == HMLFC_OK) hmlfc_stream_check_sections(&host.stream(), &error);
  if (error.code != HMLFC_OK) refuse(static_cast<unsigned>(error.code));
  host.fill_area();
  write_views(host.stream().rows, host.stream().cols, options.folder, [&](ViewPos view) {
    auto image = decode_view(host, view);
    if (!host.finding().empty()) throw Stop{kExitInternal, host.finding()};
    if (!image) refuse(image.error());
    return std::move(*image);
  });
  if (!pins.flush()) throw Stop{kExitOutput, "cannot write " + options.pins};
}

void print_stage(const LevelRecord& record, const char* name, const StageValues& values,
                 unsigned b) {
  const std::vector<int32_t> wide(values.begin(), values.begin() + b * b);
  const BlockSite& site = record.site;
  const hmlfc_dut_stage stage{name,
                              static_cast<uint32_t>(site.level),
                              site.image_row,
                              site.image_col,
                              static_cast<uint32_t>(site.plane),
                              site.bx,
                              site.by,
                              b * b,
                              wide.data()};
  fmt::print("{}\n", conform::stage_line(stage));
}

// The unit's trace port as stages.
void trace(UnitHost& unit, const std::string& place, unsigned b) {
  std::array<unsigned, 5> at{};
  if (std::sscanf(place.c_str(), "%u,%u,%u,%u,%u", &at[0], &at[1], &at[2], &at[3], &at[4]) != 5) {
    throw Stop{kExitUsage, "--trace takes row,column,plane,x,y"};
  }
  unit.on_record = [b](const LevelRecord& record) {
    if (record.error != 0) return;
    if (record.motion) print_stage(record, "reference", record.reference, b);
    if (!record.key) print_stage(record, "prediction", record.prediction, b);
    if (record.has_residual) print_stage(record, "residual", record.residual, b);
    print_stage(record, "sample", record.sample, b);
  };
  const Request request{.row = at[0], .col = at[1], .bx = at[3], .by = at[4], .plane = at[2]};
  unit.answers(std::span(&request, 1));
}

void run(const Options& options) {
  const auto file = io::MappedFile::open(options.file);
  if (!file) throw Stop{kExitUsage, file.error().message};
  if (options.views) return run_views(options, file->bytes());
  const auto makers = rtl_units();
  const UnitMaker& maker = maker_for(makers, file->bytes());
  const StreamImage image(file->bytes(), maker.parameters);
  std::ofstream pins;
  UnitHost::OnClock on_clock;
  PinRecord record(pins, maker.parameters);
  if (!options.pins.empty()) {
    pins.open(options.pins);
    on_clock = [&](const UnitInputs& in, const UnitOutputs& out) { record.add(in, out); };
  }
  UnitHost unit(maker.make(maker.parameters), file->bytes(), image.area().bytes, on_clock);
  if (!options.pins.empty()) unit.set_pauses(1);
  if (const uint8_t error = unit.load(); error != 0) refuse(error);
  // The unit leaves to software the CRCs of sections (FIL-6) and the TOP table (KEY-1).
  const auto opened = Decoder::open(file->bytes());
  if (!opened) refuse(static_cast<unsigned>(opened.error().code));
  if (image.golden() == nullptr) refuse(image.load_error());
  if (!options.trace.empty()) {
    return trace(unit, options.trace, opened->header().block_size());
  }
  const GoldenStream& golden = *image.golden();
  write_views(golden.header().rows, golden.header().cols, options.folder,
              [&](ViewPos view) { return decode(unit, golden, view); });
  if (!pins.flush()) throw Stop{kExitOutput, "cannot write " + options.pins};
}

int main_of(int argc, char** argv) {
  CLI::App app{"Decodes all views of a stream in the Verilated decode unit, into DIR/views.raw"};
  Options options;
  app.add_option("FILE", options.file, "An .hmlfc file")->required();
  app.add_option("-o,--output", options.folder, "An existing folder");
  app.add_option("--trace", options.trace,
                 "Print the stages of one block as JSON lines: row,column,plane,x,y");
  app.add_option(
      "--pins", options.pins,
      "Record the unit's pins for rtl/kit/pin_replay.sv, with --views for view_pin_replay.sv; "
      "the memory pauses");
  app.add_flag("--views", options.views, "By descriptors of the view unit, in place of requests");
  CLI11_PARSE(app, argc, argv);
  try {
    run(options);
    return 0;
  } catch (const Stop& stop) {
    fmt::print(stderr, "rtl_decode: {}: {}\n", options.file.string(), stop.message);
    return stop.exit_code;
  } catch (const UnitHangs& hang) {
    fmt::print(stderr, "rtl_decode: {}: {}\n", options.file.string(), hang.what());
    return kExitInternal;
  }
}

}  // namespace
}  // namespace hmlfc::tb

int sc_main(int argc, char** argv) { return hmlfc::tb::main_of(argc, argv); }
