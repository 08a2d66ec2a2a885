// hwy::Prefetch, for builds without Highway.
#pragma once

namespace hwy {
template <class T>
inline void Prefetch(const T* place) {
  __builtin_prefetch(place);
}
}  // namespace hwy
