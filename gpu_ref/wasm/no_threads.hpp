// Locks for a C++ library without threads; included before every file.
#pragma once

#ifdef __cplusplus
#include <mutex>

namespace std {

class mutex {
 public:
  void lock() {}
  void unlock() {}
};

template <class... Mutexes>
class scoped_lock {
 public:
  explicit scoped_lock(Mutexes&...) {}
};

}  // namespace std
#endif
