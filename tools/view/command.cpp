// hmlfc view: a page in a browser that looks through a light field and into its stream.
#include <csignal>
#include <ctime>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "cli/arguments.hpp"
#include "cli/commands.hpp"
#include "view/browser.hpp"
#include "view/server.hpp"

namespace hmlfc::cli {
namespace {

struct ViewOptions {
  std::filesystem::path file;
  std::filesystem::path original;
  uint16_t port = 0;
  bool no_browser = false;
  bool once = false;
};

// Keeps Ctrl-C from ending the process, in this thread and those that it starts.
class HeldSignals {
 public:
  HeldSignals() {
    sigemptyset(&signals_);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals_, signal);
    pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
  }

  /// Whether one came within a fifth of a second.
  bool came() const {
    const timespec wait{0, 200'000'000};
    return sigtimedwait(&signals_, nullptr, &wait) > 0;
  }

 private:
  sigset_t signals_{};
};

ExitCode run_view(const ViewOptions& options) {
  const HeldSignals signals;
  view::OpenStream stream(options.file, options.original);
  if (!stream.error().empty()) note(stream.error());
  if (!stream.warning().empty()) note(stream.warning());
  view::Server server(options.port);
  const view::Site site{server.port(), view::random_token()};
  view::Handler handler(site, stream);
  server.start(handler);
  print(fmt::format("{}\n", site.address()));
  flush_output();
  note("Ctrl-C ends it");
  std::optional<view::Browser> browser;
  if (!options.no_browser) browser.emplace(site.address());
  while (!signals.came()) {
    if (options.once && handler.pages().all_closed(std::chrono::steady_clock::now())) break;
  }
  server.stop();
  return ExitCode::kDone;
}

}  // namespace

void add_viewer(CLI::App& program, Task& task) {
  const auto [app, options] = add_command(
      program, task, "view", "Look through a light field and into its stream in a browser",
      run_view,
      R"(Prints the address of a page and opens it in a browser, where there is one. Only programs of this
machine reach it, and only with that address. A corrupt stream is shown as far as it can be.

Example:
  hmlfc view chess.hmlfc --original views)");
  add_stream(app, options.file);
  add_path(app, "--original", options.original, "The views it was made of, to compare with")
      ->required(false)
      ->type_name("DIR");
  add_integer(app, "--port", options.port, 0, 65535, "Port of 127.0.0.1, 0 for any that is free");
  app.add_flag("--no-browser", options.no_browser, "Only print the address");
  app.add_flag("--once", options.once, "End when the page is closed");
}

}  // namespace hmlfc::cli
