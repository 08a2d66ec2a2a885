// The functions of Highway's library that code with several instruction sets calls, for programs in
// one file: Debian has that library as a shared one alone.
#include <hwy/targets.h>

hwy::ChosenTarget& hwy::GetChosenTarget() {
  static ChosenTarget chosen;
  return chosen;
}

int64_t hwy::SupportedTargets() {
  int64_t targets = HWY_STATIC_TARGET;
#if HWY_ARCH_X86_64
  if (!__builtin_cpu_supports("aes") || !__builtin_cpu_supports("pclmul")) return targets;
  if (__builtin_cpu_supports("sse4.2")) targets |= HWY_SSE4;
  if (__builtin_cpu_supports("x86-64-v3")) targets |= HWY_AVX2;
  if (__builtin_cpu_supports("x86-64-v4")) targets |= HWY_AVX3;
#endif
  return targets;
}
