// What MinGW's <unistd.h>, <stdlib.h>, <stdio.h> and <sys/stat.h> have not of POSIX.
#pragma once

#include_next <unistd.h>

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <wchar.h>

#define _SC_PAGESIZE 1
#define _SC_PHYS_PAGES 2
long sysconf(int name);

ssize_t pread(int file, void* to, size_t bytes, int64_t offset);
ssize_t pwrite(int file, const void* from, size_t bytes, int64_t offset);
ssize_t write(int file, const void* from, size_t bytes);
int fsync(int file);

int access(const wchar_t* path, int mode);
int unlink(const wchar_t* path);
/// Replaces `to`, unless somebody has it open in another way than open() here or maps it.
int rename(const wchar_t* from, const wchar_t* to);
/// There are no files without a name, to which to link.
inline int linkat(int, const char*, int, const wchar_t*, int) { return -1; }
/// Permissions are those of the folder.
inline int fchmod(int, int) { return 0; }

/// Gone once it is closed, which takes the place of removing its name at once.
int mkostemp(char* name, int flags);
int mkstemps(char* name, int suffix);
char* mkdtemp(char* name);
