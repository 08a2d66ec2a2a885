#include <sys/utsname.h>
#include <unistd.h>

#include <ctime>
#include <fstream>
#include <thread>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "conform/report_files.hpp"

namespace hmlfc::conform {
namespace {

// The first value of "model name : ..." in /proc/cpuinfo.
std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const size_t colon = line.find(':');
    if (line.starts_with("model name") && colon != std::string::npos) {
      return line.substr(std::min(colon + 2, line.size()));
    }
  }
  return "unknown";
}

}  // namespace

SystemInfo this_system(const std::string& program) {
  utsname name{};
  ::uname(&name);
  const auto pages = static_cast<uint64_t>(::sysconf(_SC_PHYS_PAGES));
  const auto page = static_cast<uint64_t>(::sysconf(_SC_PAGESIZE));
  return {program,
          fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))),
          fmt::format("{} {} {}", name.sysname, name.release, name.machine),
          processor_name(),
          std::thread::hardware_concurrency(),
          pages * page >> 20};
}

}  // namespace hmlfc::conform
