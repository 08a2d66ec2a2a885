// hmlfc view: a page in a browser that looks through a light field and into its stream.
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "cli/arguments.hpp"
#include "cli/block_request.hpp"
#include "cli/commands.hpp"
#include "cli/dut_options.hpp"
#include "view/browser.hpp"
#include "view/server.hpp"

namespace hmlfc::cli {
namespace {

struct ViewOptions {
  std::filesystem::path file;
  std::filesystem::path original;
  io::ViewNaming naming;  // of the original
  DutOptions dut;
  BlockRequest block;
  uint16_t port = 0;
  bool no_ahead = false;
  bool no_browser = false;
  bool once = false;
};

constexpr std::array kEndSignals{SIGINT, SIGTERM, SIGHUP};
constexpr std::chrono::milliseconds kGrace{500};
int end_event = -1;  // an eventfd: a signal to end has come

extern "C" void on_end_signal(int signal) {
  static std::atomic_flag came;
  if (!came.test_and_set()) {
    const uint64_t one = 1;
    [[maybe_unused]] const ssize_t written = ::write(end_event, &one, sizeof one);
  } else {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

// From here on a first signal to end is left to end_is_wanted(); a second one ends the process.
void catch_end_signals() {
  end_event = ::eventfd(0, EFD_CLOEXEC);
  if (end_event < 0) throw std::system_error(errno, std::generic_category(), "eventfd");
  for (const int signal : kEndSignals) std::signal(signal, on_end_signal);
}

// Whether a signal to end comes within a fifth of a second.
bool end_is_wanted() {
  pollfd entry{end_event, POLLIN, 0};
  return ::poll(&entry, 1, 200) > 0;
}

// Ends the process after kGrace unless it has ended by then: an answer that is still worked out
// would be for nobody, and leaves nothing behind.
void end_soon() {
  std::thread([] {
    std::this_thread::sleep_for(kGrace);
    std::_Exit(static_cast<int>(ExitCode::kDone));
  }).detach();
}

// What stands behind the address of the page to open the block that the options name, or nothing.
std::string link_to(const BlockRequest& block, const view::OpenStream& stream, bool with_other) {
  if (!block.view) return "";
  if (stream.error().empty()) check_place(stream.for_blocks(), block);
  const std::string levels = block.levels ? fmt::format("&levels={}", *block.levels) : "";
  return fmt::format("#mode=into&view={},{}&plane={}&block={},{}{}{}", block.view->row,
                     block.view->col, plane_name(block.plane), block.block[0], block.block[1],
                     levels, with_other ? "&overlay=dut&beside=dut-picture" : "");
}

// The decoder of --dut, or null.
std::unique_ptr<view::OtherDecoder> other_decoder(const DutOptions& options,
                                                  const view::OpenStream& stream) {
  if (options.names.empty()) return nullptr;
  auto duts = options.read();
  if (!stream.error().empty()) return nullptr;
  const StreamFile& file = stream.for_blocks();
  if (file.is_remote()) {
    note(fmt::format("--dut reads a file: all {} bytes of {} are fetched for its first answer",
                     grouped(file.size()), file.path().string()));
  }
  return std::make_unique<view::OtherDecoder>(std::move(duts.front()), options.limits(), file);
}

ExitCode run_view(const ViewOptions& options) {
  if (options.original.empty()) refuse_naming(options.naming, "it is for the folder of --original");
  view::OpenStream stream(options.file, options.original, options.naming);
  const auto other = other_decoder(options.dut, stream);
  const std::string link = link_to(options.block, stream, other != nullptr);
  if (!stream.error().empty()) note(stream.error());
  if (!stream.warning().empty()) note(stream.warning());
  const view::Port port(options.port);
  const view::Site site{port.number(), view::random_token()};
  view::Handler handler(site, stream, other.get(), !options.no_ahead);
  const view::Server server(port, handler);
  catch_end_signals();
  const std::string address = site.address() + link;
  print(address + "\n");
  flush_output();
  note("Ctrl-C ends it");
  std::optional<view::Browser> browser;
  if (!options.no_browser) browser.emplace(address);
  while (!end_is_wanted()) {
    if (options.once && handler.pages().all_closed(std::chrono::steady_clock::now())) break;
  }
  end_soon();
  browser.reset();
  if (other) other->end();
  return ExitCode::kDone;
}

}  // namespace

void add_viewer(CLI::App& program, Task& task) {
  const auto [app, options] = add_command(
      program, task, "view", "Look through a light field and into its stream in a browser",
      run_view,
      R"(Prints the address of a page and opens it in a browser, where there is one. Only programs of this
machine reach it, and only with that address. A corrupt stream is shown as far as it can be.

With --dut the page shows a decoder beside this one, as hmlfc conform runs it. --view, --plane and
--block open a block; a report of hmlfc conform has the command for each failure.

Examples:
  hmlfc view chess.hmlfc --original views
  hmlfc view chess.hmlfc --dut './mydec {input} -o {output}' --view 3,4 --plane Y --block 10,7)");
  add_stream(app, options.file);
  add_path(app, "--original", options.original, "The views it was made of, to compare with")
      ->required(false)
      ->type_name("DIR");
  add_naming(app, options.naming);
  options.dut.add_to(app, false);
  add_block_options(app, options.block, false);
  add_integer(app, "--port", options.port, 0, 65535, "Port of 127.0.0.1, 0 for any that is free");
  app.add_flag("--no-ahead", options.no_ahead,
               "Decode key images when a frame needs them, not ahead of the motion");
  app.add_flag("--no-browser", options.no_browser, "Only print the address");
  app.add_flag("--once", options.once, "End when the page is closed");
}

}  // namespace hmlfc::cli
