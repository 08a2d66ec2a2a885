// The query of a request, read as the options of a command: the same names, intervals and messages.
#pragma once

#include <functional>

#include <CLI/CLI.hpp>

#include "cli/camera_options.hpp"
#include "view/exchange.hpp"

namespace hmlfc::view {

/// Sets the options that `add` adds to an empty command from `query`: "focus=1.5" is --focus=1.5.
/// Options that take a path cannot be named. Failure (kUsage): an option that is not there, twice
/// or missing, or a value outside its interval.
void read_query(const Query& query, const std::function<void(CLI::App&)>& add);

/// A camera and the levels of the tree, as options of `hmlfc render`.
struct LookQuery {
  cli::CameraOptions cameras;
  std::optional<int> levels;
};

/// The frame that `query` asks for, without --path, next to the options that `add` adds. Failures:
/// those of read_query.
LookQuery read_look_query(
    const Query& query, const std::function<void(CLI::App&)>& add = [](CLI::App&) {});

}  // namespace hmlfc::view
