// decode: all views of a stream by the view unit with its driver, or requests for blocks to the
// decode unit, by the line protocol. The decoders of vectors/duts/.
#include <filesystem>

#include "conform/line_server.hpp"
#include "conform/output_views.hpp"
#include "programs/commands.hpp"
#include "programs/unit_decoder.hpp"
#include "unit/units.hpp"
#include "vectors/digest.hpp"
#include "view/view_pictures.hpp"

namespace hmlfc::tb {
namespace {

constexpr int kExitRefused = 4;
constexpr int kExitInternal = 70;
constexpr int kExitOutput = 74;
constexpr int kExitSkipped = 77;

struct Options {
  std::string file;
  std::filesystem::path folder;
  bool serve = false;
};

[[noreturn]] void refuse(unsigned status) { throw Stop{status_name(status), kExitRefused}; }

// Writes all views. The driver checks the stream and fills the reference area; the golden model has
// no part in it.
int write_views(const Options& options) {
  const MappedFile file = read_file(options.file);
  const auto makers = view_units();
  const UnitMaker* maker = unit_for(makers, file.bytes());
  if (maker == nullptr) throw Stop{"this build has no view unit", kExitSkipped};
  ViewHost host(maker->make(maker->parameters, nullptr), file.bytes(), 4);
  hmlfc_error error = host.stream_error();
  if (error.code == HMLFC_OK) hmlfc_stream_check_sections(&host.stream(), &error);
  if (error.code != HMLFC_OK) refuse(static_cast<unsigned>(error.code));
  host.fill_area();
  auto raw = io::AtomicFile::create(options.folder / conform::kRawViewsName);
  if (!raw) throw Stop{raw.error().message, kExitOutput};
  const uint32_t cols = host.stream().cols;
  for (uint32_t view = 0; view < host.stream().rows * cols; ++view) {
    const auto image = decode_view(host, {view / cols, view % cols});
    if (!host.finding().empty()) throw Stop{host.finding(), kExitInternal};
    if (!image) refuse(image.error());
    const auto done = raw->write(vectors::picture_bytes(*image));
    if (!done) throw Stop{done.error().message, kExitOutput};
  }
  if (const auto done = raw->commit(); !done) throw Stop{done.error().message, kExitOutput};
  return 0;
}

// The unit's answers to the requests of standard input.
int serve() {
  switch (conform::serve_lines(unit_functions())) {
    case conform::ServeEnd::kInput:
      return 0;
    case conform::ServeEnd::kOutput:
      throw Stop{"cannot write", kExitOutput};
    case conform::ServeEnd::kCannotRun:
      throw Stop{"this build has no Verilated unit", kExitSkipped};
    case conform::ServeEnd::kNoFile:
      throw Stop{"cannot read"};
  }
  return kExitInternal;
}

}  // namespace

Command add_decode(CLI::App& app) {
  auto options = std::make_shared<Options>();
  auto* input = app.add_option_group("input")->require_option(1);
  input->add_option("FILE", options->file, "Decode all views of this stream in the view unit");
  input->add_flag("--serve", options->serve,
                  "Speak the line protocol (docs/line_protocol.md) for the decode unit");
  app.add_option("-o,--output", options->folder, "An existing folder for views.raw");
  return [options] { return options->serve ? serve() : write_views(*options); };
}

}  // namespace hmlfc::tb
