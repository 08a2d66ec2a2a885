// Simulates ulx3s beside a host's program, for which it is a serial port:
//   fpga_bench PROGRAM ARG...          runs PROGRAM PORT ARG...; the exit status is the program's
#include <fcntl.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <optional>
#include <vector>

#include "Vulx3s.h"

namespace {

constexpr int kClocksPerBit = CLOCKS_PER_BIT;
constexpr int kFrameBits = 10;
constexpr int kResetClocks = 16;

// One direction of the line: a byte at a time, from the start bit to the stop bit.
class Sender {
 public:
  bool idle() const { return left_ == 0; }
  void begin(unsigned char byte) {
    bits_ = 1U << 9 | unsigned{byte} << 1;
    left_ = kFrameBits * kClocksPerBit;
  }
  // The level of the line in the next clock.
  bool step() {
    if (left_ == 0) return true;
    return bits_ >> (kFrameBits - 1 - (--left_ / kClocksPerBit)) & 1;
  }

 private:
  unsigned bits_ = 0;
  int left_ = 0;
};

class Receiver {
 public:
  // The byte that ends with this level of the line.
  std::optional<unsigned char> step(bool level) {
    if (clocks_ == 0 && level) return {};
    const int middle = clocks_++ - kClocksPerBit / 2;
    if (middle % kClocksPerBit == 0 && middle > 0) bits_ = bits_ >> 1 | unsigned{level} << 8;
    if (middle < (kFrameBits - 1) * kClocksPerBit) return {};
    clocks_ = 0;
    return static_cast<unsigned char>(bits_);
  }

 private:
  unsigned bits_ = 0;
  int clocks_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  const int line = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
  if (argc < 2 || line < 0 || grantpt(line) != 0 || unlockpt(line) != 0) return 2;
  std::vector<char*> command(argv + 1, argv + argc);
  command.insert(command.begin() + 1, ptsname(line));
  command.push_back(nullptr);
  const pid_t program = fork();
  if (program == 0) {
    execv(command[0], command.data());
    _exit(127);
  }

  Vulx3s top;
  Sender sender;
  Receiver receiver;
  unsigned char byte;
  int status;
  for (long long clocks = 0;; ++clocks) {
    if (clocks > kResetClocks && sender.idle() && read(line, &byte, 1) == 1) sender.begin(byte);
    top.ftdi_txd = sender.step();
    top.btn_fire1 = clocks < kResetClocks / 2;
    for (const int level : {0, 1}) {
      top.clk_25mhz = level;
      top.eval();
    }
    const auto came = receiver.step(top.ftdi_rxd);
    while (came && write(line, &*came, 1) != 1) usleep(100);
    if (clocks % 1000 == 0 && waitpid(program, &status, WNOHANG) == program) {
      std::printf("fpga_bench: %lld clocks\n", clocks);
      return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
    }
  }
}
