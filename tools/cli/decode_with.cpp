// hmlfc decode-with: views of a stream by a decoder in a shared library (hmlfc_dut.h).
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/arguments.hpp"
#include "conform/dut_library.hpp"
#include "conform/output_views.hpp"
#include "conform/stage_trace.hpp"
#include "io/files.hpp"
#include "vectors/digest.hpp"

namespace hmlfc::cli {
namespace {

struct DecodeWithOptions {
  std::filesystem::path library;
  std::filesystem::path file;
  std::filesystem::path folder;
  std::optional<std::array<uint32_t, 5>> trace;  ///< view row, col, plane, block x, y
  bool by_block = false;
};

// The value of `result`; a refusal by the library counts as a corrupt stream.
template <class T>
T library_value(conform::DutResult<T> result, const std::filesystem::path& file) {
  if (!result) {
    if (result.error().cannot_run) {
      throw Failure(ExitCode::kCannotRun, result.error().where + ": the decoder cannot run here");
    }
    throw Failure(ExitCode::kCorrupt, fmt::format("{}: {}: {}", file.string(), result.error().where,
                                                  result.error().name));
  }
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

void print_stage(void*, const hmlfc_dut_stage* stage) { print(conform::stage_line(*stage) + "\n"); }

ExitCode trace(const conform::LibraryDecoder& decoder, const DecodeWithOptions& options) {
  const auto& [row, col, plane, block_x, block_y] = *options.trace;
  const BlockAddress block{{row, col}, static_cast<Plane>(plane), block_x, block_y};
  library_value(decoder.trace(block, print_stage, nullptr), options.file);
  return ExitCode::kDone;
}

ExitCode run_decode_with(const DecodeWithOptions& options) {
  const auto functions =
      value_or_throw(conform::load_dut_library(options.library), ExitCode::kNoDecoder);
  const auto file = value_or_throw(io::MappedFile::open(options.file), ExitCode::kInput);
  const auto decoder =
      library_value(conform::LibraryDecoder::open(functions, file.bytes()), options.file);
  if (options.trace) return trace(decoder, options);
  if (options.folder.empty()) throw Failure(ExitCode::kUsage, "--output is required");
  make_output_folder(options.folder);
  const auto path = options.folder / conform::kRawViewsName;
  auto raw = value_or_throw(io::AtomicFile::create(path), ExitCode::kOutput);
  const hmlfc_dut_geometry& geometry = decoder.geometry();
  for (uint32_t row = 0; row < geometry.rows; ++row) {
    for (uint32_t col = 0; col < geometry.cols; ++col) {
      const auto image = library_value(options.by_block ? decoder.decode_view_by_block({row, col})
                                                        : decoder.decode_view({row, col}),
                                       options.file);
      value_or_throw(raw.write(vectors::picture_bytes(image)), ExitCode::kOutput);
    }
  }
  value_or_throw(raw.commit(), ExitCode::kOutput);
  print(fmt::format("{}: {} views of {} x {} pixels by {}\n", path.string(),
                    geometry.rows * geometry.cols, geometry.width, geometry.height,
                    functions.name()));
  return ExitCode::kDone;
}

}  // namespace

void add_decode_with(CLI::App& program, Task& task) {
  const auto [app, options] = add_command(
      program, task, "decode-with", "Decode a stream with a decoder in a shared library",
      run_decode_with,
      R"(Writes the file views.raw: all views in row order, each pixel row by row as R, G, B; one byte per
sample at 8 bits, two bytes, little-endian, above. `hmlfc conform` runs libraries in this way. --trace
takes view row and column, plane (0 Y, 1 Co, 2 Cg), block column and row.

Example:
  hmlfc decode-with libhmlfc_dut_model.so chess.hmlfc -o decoded)");
  add_path(app, "LIBRARY", options.library, "A library with the functions of hmlfc_dut.h");
  add_stream(app, options.file);
  add_output(app, options.folder, "DIR", "Folder for views.raw, created if missing")
      ->required(false);
  app.add_flag("--by-block", options.by_block, "Ask the library for blocks instead of views");
  const auto set_trace = [&target = options.trace](const std::array<uint32_t, 5>& numbers) {
    target = numbers;
    return numbers[2] < kPlaneCount;
  };
  add_numbers<5>(app, "--trace", "R,C,P,X,Y", ',',
                 "row,column,plane,x,y with plane 0, 1 or 2, such as 3,5,0,12,7",
                 "Print the stages of one block as JSON lines instead", set_trace);
}

}  // namespace hmlfc::cli
