// Libraries that are loaded by a running program.
#pragma once

#define RTLD_NOW 0
#define RTLD_LOCAL 0

void* dlopen(const wchar_t* file, int flags);
void* dlsym(void* library, const char* name);
const char* dlerror();
