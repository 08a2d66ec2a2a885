// Random numbers of the system.
#pragma once

#include <stddef.h>
#include <sys/types.h>

ssize_t getrandom(void* to, size_t bytes, unsigned flags);
