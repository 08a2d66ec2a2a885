#include "cli/stream_file.hpp"

#include <utility>

#include <fmt/format.h>

#include "cli/output.hpp"

namespace hmlfc::cli {

StreamFile::StreamFile(std::filesystem::path path, const OpenOptions& options)
    : path_(std::move(path)),
      file_(value_or_throw(io::MappedFile::open(path_), ExitCode::kInput)),
      decoder_(value_or_throw(Decoder::open(file_.bytes(), options), path_)) {}

void StreamFile::check_view(ViewPos view) const {
  if (view.row < header().rows && view.col < header().cols) return;
  throw Failure(ExitCode::kUsage,
                fmt::format("--view {},{} is outside the grid of {} x {} views of {}", view.row,
                            view.col, header().rows, header().cols, path_.string()));
}

int StreamFile::stop_level(int levels) const {
  const int all = header().tree_height + 1;
  if (levels >= 1 && levels <= all) return all - levels;
  throw Failure(ExitCode::kUsage,
                fmt::format("--levels {} is outside [1, {}]: {} has {} level{}; encode with a "
                            "larger --height for more",
                            levels, all, path_.string(), all, all == 1 ? "" : "s"));
}

}  // namespace hmlfc::cli
