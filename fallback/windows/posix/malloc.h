// Memory that is freed goes back to Windows as Windows likes.
#pragma once

#include_next <malloc.h>

#define M_MMAP_THRESHOLD -3
#define M_TRIM_THRESHOLD -1
inline int mallopt(int, int) { return 1; }
