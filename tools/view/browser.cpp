#include "view/browser.hpp"

#include <spawn.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>

#include "io/files.hpp"

namespace hmlfc::view {

namespace {

bool has_desktop() {
  return std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
}

// A page that leads to `address`, or empty where it cannot be written.
std::string write_page(const std::string& address) {
  std::error_code failure;
  std::string name = (std::filesystem::temp_directory_path(failure) / "hmlfc-XXXXXX.html").string();
  const io::FileDescriptor file(mkstemps(name.data(), 5));  // mode 0600
  if (file.get() < 0) return "";
  const std::string page =
      fmt::format("<!doctype html><meta http-equiv=\"refresh\" content=\"0;url={}\">", address);
  const bool whole =
      ::write(file.get(), page.data(), page.size()) == static_cast<ssize_t>(page.size());
  if (!whole) ::unlink(name.c_str());
  return whole ? name : "";
}

}  // namespace

Browser::Browser(const std::string& address) {
  if (!has_desktop()) return;
  file_ = write_page(address);
  if (file_.empty()) return;
  std::string program = "xdg-open";
  char* const arguments[] = {program.data(), file_.data(), nullptr};
  posix_spawnattr_t own_session;  // Ctrl-C does not reach it
  posix_spawnattr_init(&own_session);
  posix_spawnattr_setflags(&own_session, POSIX_SPAWN_SETSID);
  pid_t child = 0;
  posix_spawnp(&child, program.c_str(), nullptr, &own_session, arguments, environ);
  posix_spawnattr_destroy(&own_session);
}

Browser::~Browser() {
  if (!file_.empty()) ::unlink(file_.c_str());
}

}  // namespace hmlfc::view
