// What MinGW's <fcntl.h> has not of POSIX.
#pragma once

#include_next <fcntl.h>
#include <wchar.h>

#define O_CLOEXEC _O_NOINHERIT
#define O_NOFOLLOW 0
#define O_NONBLOCK 0
#define O_TMPFILE 0  // of a folder, which open() refuses: there are no files without a name
#define AT_FDCWD -100
#define AT_SYMLINK_FOLLOW 0x400

/// In binary mode; others may rename and delete the file meanwhile.
int open(const wchar_t* path, int flags, int mode = 0);
