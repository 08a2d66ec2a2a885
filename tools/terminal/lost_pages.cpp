#include "terminal/lost_pages.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>

namespace hmlfc::terminal {
namespace {

volatile std::sig_atomic_t lost = 0;
const auto page_bytes = static_cast<uintptr_t>(::sysconf(_SC_PAGESIZE));

// A page of zeros in place of the one that is gone; else the access, made again, ends the program.
void replace_page(int signal, siginfo_t* info, void*) {
  const uintptr_t page = reinterpret_cast<uintptr_t>(info->si_addr) & ~(page_bytes - 1);
  constexpr int kHow = MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED;
  if (info->si_code != BUS_ADRERR ||
      ::mmap(reinterpret_cast<void*>(page), page_bytes, PROT_READ, kHow, -1, 0) == MAP_FAILED) {
    std::signal(signal, SIG_DFL);
    return;
  }
  lost = 1;
}

}  // namespace

void survive_lost_pages() {
  struct sigaction action {};
  action.sa_sigaction = &replace_page;
  action.sa_flags = SA_SIGINFO;
  ::sigaction(SIGBUS, &action, nullptr);
}

bool pages_were_lost() { return lost != 0; }

}  // namespace hmlfc::terminal
