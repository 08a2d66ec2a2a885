// What a shared object has to give Debian's archives, which are made for programs of the same
// Debian; the linker leads them here (--wrap).
#include <sys/random.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>

// They have the addresses of stdout and stderr in their code, where those of another object cannot
// be.
extern std::FILE* system_stdout __asm__("__real_stdout");
extern std::FILE* system_stderr __asm__("__real_stderr");
__attribute__((visibility("hidden"))) extern std::FILE* own_stdout __asm__("__wrap_stdout");
__attribute__((visibility("hidden"))) extern std::FILE* own_stderr __asm__("__wrap_stderr");
std::FILE* own_stdout = system_stdout;
std::FILE* own_stderr = system_stderr;

// The C library has arc4random from 2.36 on, which for std::random_device alone would leave out
// older systems.
extern uint32_t own_random() __asm__("__wrap_arc4random");
uint32_t own_random() {
  uint32_t number = 0;
  if (::getrandom(&number, sizeof(number), 0) != sizeof(number)) std::abort();
  return number;
}
