// rtl_decode: all views of a stream by the Verilated decode unit, block by block, or by the view
// unit with its driver; or single blocks, by the line protocol. A decoder for `hmlfc conform`.
#include <cstdio>
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "conform/line_server.hpp"
#include "conform/output_views.hpp"
#include "io/files.hpp"
#include "programs/unit_decoder.hpp"
#include "syntax/header.hpp"
#include "vectors/digest.hpp"
#include "view/view_pictures.hpp"
#include "view/view_units.hpp"

namespace hmlfc::tb {
namespace {

constexpr int kExitUsage = 2;
constexpr int kExitRefused = 4;
constexpr int kExitInternal = 70;
constexpr int kExitOutput = 74;
constexpr int kExitSkipped = 77;

constexpr const char* kNoUnit = "this build has no Verilated unit";

// Ends the program with a message.
struct Stop {
  int exit_code;
  std::string message;
};

struct Options {
  std::filesystem::path file;
  std::filesystem::path folder;
  bool views = false;
  bool serve = false;
};

[[noreturn]] void refuse(unsigned status) { throw Stop{kExitRefused, status_name(status)}; }

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

// The driver checks the stream and fills the reference area; the golden model has no part in it.
void run_views(const Options& options, std::span<const uint8_t> file) {
  const auto makers = view_units();
  if (makers.empty()) throw Stop{kExitSkipped, "this build has no view unit"};
  const auto header = parse_header(file);
  const ViewMaker* maker =
      header ? view_unit_for(makers, header->block_log2, header->depth) : &makers.front();
  if (maker == nullptr) maker = &makers.front();
  Oracle unused(0);
  ViewHost host(maker->make(maker->parameters, unused), file, 4);
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
}

// The unit's answers for the requests of standard input.
void serve() {
  switch (conform::serve_lines(unit_functions())) {
    case conform::ServeEnd::kInput:
      return;
    case conform::ServeEnd::kOutput:
      throw Stop{kExitOutput, "cannot write"};
    case conform::ServeEnd::kCannotRun:
      throw Stop{kExitSkipped, kNoUnit};
    case conform::ServeEnd::kNoFile:
      throw Stop{kExitUsage, "cannot read"};
  }
}

void run(const Options& options) {
  if (options.serve) return serve();
  const auto file = io::map_file(options.file);
  if (!file) throw Stop{kExitUsage, file.error().message};
  if (options.views) return run_views(options, file->bytes());
  if (UnitDecoder::maker_for(file->bytes()) == nullptr) throw Stop{kExitSkipped, kNoUnit};
  const auto decoder = UnitDecoder::open(file->bytes());
  if (!decoder) refuse(static_cast<unsigned>(decoder.error()));
  const StreamHeader& header = (*decoder)->header();
  write_views(header.rows, header.cols, options.folder, [&](ViewPos view) {
    auto image = (*decoder)->view(view);
    if (!image) refuse(static_cast<unsigned>(image.error()));
    return std::move(*image);
  });
}

int main_of(int argc, char** argv) {
  CLI::App app{
      "Decodes all views of a stream in the Verilated decode unit, into DIR/views.raw, or answers\n"
      "requests for its blocks"};
  Options options;
  auto* file = app.add_option("FILE", options.file, "An .hmlfc file");
  app.add_option("-o,--output", options.folder, "An existing folder");
  app.add_flag("--views", options.views, "By descriptors of the view unit, in place of requests");
  app.add_flag("--serve", options.serve, "Speak the line protocol (docs/line_protocol.md)")
      ->excludes(file);
  CLI11_PARSE(app, argc, argv);
  try {
    if (!options.serve && options.file.empty()) throw Stop{kExitUsage, "FILE or --serve is needed"};
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
