// The loops of bits/parallel.hpp in one thread, and what C++ without exceptions lacks: a throw ends
// the module.
#include <cstdlib>

#include "bits/parallel.hpp"

namespace hmlfc {

void parallel_for(size_t count, const std::function<void(size_t)>& body) {
  for (size_t i = 0; i < count; ++i) body(i);
}

}  // namespace hmlfc

extern "C" {
void* __cxa_allocate_exception(size_t) { std::abort(); }
void __cxa_throw(void*, void*, void (*)(void*)) { std::abort(); }
void* __cxa_begin_catch(void*) { std::abort(); }
void __cxa_end_catch() { std::abort(); }
void __cxa_rethrow() { std::abort(); }

// OpenJPEG without threads refuses to be told that it has none.
int __wrap_opj_codec_set_threads(void*, int) { return 1; }
}
