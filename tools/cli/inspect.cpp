// hmlfc inspect: shows how one block is decoded, field by field and stage by stage.
#include <filesystem>

#include <nlohmann/json.hpp>

#include "cli/arguments.hpp"
#include "cli/block_report.hpp"
#include "cli/block_request.hpp"
#include "cli/view_source.hpp"

namespace hmlfc::cli {
namespace {

struct InspectOptions {
  std::filesystem::path file;
  BlockRequest request;
  bool json = false;
};

ExitCode run_inspect(const InspectOptions& options) {
  const StreamFile file(options.file);
  BlockReport report;
  file.value(report_on_block(file, options.request, report));
  print_result(options.json, to_json(report), to_text(report));
  return ExitCode::kDone;
}

}  // namespace

void add_inspect(CLI::App& program, Task& task) {
  const auto [app, options] = add_command(
      program, task, "inspect", "Show how one block is decoded", run_inspect,
      R"(For each level, from the top: every field that is read, with its address from the start of the
file, its value and the clause of the specification that defines it; the motion vectors in samples of
the block's plane; the values of each stage in sample steps. Values in bounded integer sequences have
the address of the sequence. Reference blocks are decoded on demand, as by a decoder without a cache.

JSON keys: view, plane, block, levels[]{level, image, kind, state, fields[]{section, byte, bit, bits,
name, clause, value}, vectors[]{image, x, y, unit, clause}, reference_blocks[]{image, block, fields},
stages{}{clause, values}}, cost{walks, fields, bits, bytes, steps}. In streams with motion tiles a
level may also have motion_fields[] and disparity{image, fields[]}.

Example:
  hmlfc inspect chess.hmlfc --view 3,5 --plane Y --block 10,7)");
  add_stream(app, options.file);
  add_block_options(app, options.request);
  add_json(app, options.json);
}

}  // namespace hmlfc::cli
