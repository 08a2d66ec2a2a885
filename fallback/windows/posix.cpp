// The functions that posix/ declares.
#include <windows.h>

#include <bcrypt.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <fnmatch.h>
#include <io.h>
#include <openssl/evp.h>
#include <sys/ioctl.h>
#include <sys/random.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <random>
#include <string_view>
#include <utility>

#include "names.hpp"

namespace hmlfc::windows {

std::wstring wide(std::string_view text) {
  const auto convert = [&](wchar_t* to, int room) {
    return ::MultiByteToWideChar(CP_UTF8, 0, text.data(), static_cast<int>(text.size()), to, room);
  };
  std::wstring result(static_cast<size_t>(convert(nullptr, 0)), L'\0');
  convert(result.data(), static_cast<int>(result.size()));
  return result;
}

std::string narrow(std::wstring_view text) {
  const auto convert = [&](char* to, int room) {
    return ::WideCharToMultiByte(CP_UTF8, 0, text.data(), static_cast<int>(text.size()), to, room,
                                 nullptr, nullptr);
  };
  std::string result(static_cast<size_t>(convert(nullptr, 0)), '\0');
  convert(result.data(), static_cast<int>(result.size()));
  return result;
}

}  // namespace hmlfc::windows

namespace {

using hmlfc::windows::narrow;
using hmlfc::windows::wide;

int fail(int number) {
  errno = number;
  return -1;
}

// Of an error in opening or renaming a file.
int number_of(DWORD error) {
  switch (error) {
    case ERROR_FILE_NOT_FOUND:
    case ERROR_PATH_NOT_FOUND:
    case ERROR_INVALID_NAME:
      return ENOENT;
    case ERROR_FILE_EXISTS:
    case ERROR_ALREADY_EXISTS:
      return EEXIST;
    case ERROR_DISK_FULL:
      return ENOSPC;
    default:
      return EACCES;
  }
}

HANDLE handle_of(int file) { return reinterpret_cast<HANDLE>(::_get_osfhandle(file)); }

OVERLAPPED place(int64_t offset) {
  OVERLAPPED at = {};
  at.Offset = static_cast<DWORD>(offset);
  at.OffsetHigh = static_cast<DWORD>(offset >> 32);
  return at;
}

DWORD at_once(size_t bytes) { return static_cast<DWORD>(std::min<size_t>(bytes, 1u << 30)); }

// Gives the letters X of `name`, before its last `suffix` bytes, values until make(name) is not
// negative, and returns that.
template <class Make>
int with_random_name(char* name, size_t suffix, const Make& make) {
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789";
  std::random_device random;
  char* const end = name + std::strlen(name) - suffix;
  for (int tries = 0; tries < 100; ++tries) {
    for (char* at = end - 6; at != end; ++at) *at = kLetters[random() % kLetters.size()];
    const int made = make(wide(name).c_str());
    if (made >= 0 || errno != EEXIST) return made;
  }
  return -1;
}

}  // namespace

// What libstdc++ makes wide characters with, of names above all: of UTF-8 (the linker leads it
// here, --wrap), which the C library of MinGW does not know. What UTF-16 has as two comes as two,
// the second from `state`.
extern "C" size_t __wrap_mbrtowc(wchar_t* to, const char* from, size_t bytes, mbstate_t* state) {
  if (from == nullptr) return 0;
  if (*state != 0) {
    *to = static_cast<wchar_t>(std::exchange(*state, 0));
    return 1;
  }
  const auto first = static_cast<unsigned char>(*from);
  const int length = first < 0x80 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  if (bytes < static_cast<size_t>(length)) return static_cast<size_t>(-2);
  wchar_t units[2] = {};
  const int count = ::MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, from, length, units, 2);
  if (count == 0) return static_cast<size_t>(fail(EILSEQ));
  *to = units[0];
  if (count == 2) *state = units[1];
  return *to == L'\0' ? 0 : static_cast<size_t>(count == 2 ? length - 1 : length);
}

int open(const wchar_t* path, int flags, int) {
  const bool writes = (flags & (_O_WRONLY | _O_RDWR)) != 0;
  const DWORD access = (writes ? GENERIC_WRITE : 0) | ((flags & _O_WRONLY) != 0 ? 0 : GENERIC_READ);
  const bool makes = (flags & _O_CREAT) != 0;
  const bool empties = (flags & _O_TRUNC) != 0;
  const DWORD how = (flags & _O_EXCL) != 0 ? CREATE_NEW
                    : makes                ? (empties ? CREATE_ALWAYS : OPEN_ALWAYS)
                                           : (empties ? TRUNCATE_EXISTING : OPEN_EXISTING);
  const DWORD kind =
      (flags & _O_TEMPORARY) != 0 ? FILE_FLAG_DELETE_ON_CLOSE : FILE_ATTRIBUTE_NORMAL;
  const DWORD others = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
  const HANDLE file = ::CreateFileW(path, access, others, nullptr, how, kind, nullptr);
  if (file == INVALID_HANDLE_VALUE) return fail(number_of(::GetLastError()));
  return ::_open_osfhandle(reinterpret_cast<intptr_t>(file), _O_BINARY | (flags & _O_APPEND));
}

ssize_t pread(int file, void* to, size_t bytes, int64_t offset) {
  OVERLAPPED at = place(offset);
  DWORD count = 0;
  if (::ReadFile(handle_of(file), to, at_once(bytes), &count, &at) != 0) return count;
  return ::GetLastError() == ERROR_HANDLE_EOF ? 0 : fail(EIO);
}

ssize_t pwrite(int file, const void* from, size_t bytes, int64_t offset) {
  OVERLAPPED at = place(offset);
  DWORD count = 0;
  if (::WriteFile(handle_of(file), from, at_once(bytes), &count, &at) != 0) return count;
  return fail(::GetLastError() == ERROR_DISK_FULL ? ENOSPC : EIO);
}

ssize_t write(int file, const void* from, size_t bytes) {
  return ::_write(file, from, at_once(bytes));
}

int fsync(int file) { return ::_commit(file); }

long sysconf(int name) {
  SYSTEM_INFO system = {};
  ::GetSystemInfo(&system);
  if (name == _SC_PAGESIZE) return static_cast<long>(system.dwPageSize);
  MEMORYSTATUSEX memory = {};
  memory.dwLength = sizeof(memory);
  ::GlobalMemoryStatusEx(&memory);
  return static_cast<long>(memory.ullTotalPhys / system.dwPageSize);
}

int access(const wchar_t* path, int mode) { return ::_waccess(path, mode); }

int unlink(const wchar_t* path) { return ::_wunlink(path); }

int rename(const wchar_t* from, const wchar_t* to) {
  if (::MoveFileExW(from, to, MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH) != 0) return 0;
  return fail(number_of(::GetLastError()));
}

int mkostemp(char* name, int) {
  return with_random_name(name, 0, [](const wchar_t* path) {
    return open(path, _O_RDWR | _O_CREAT | _O_EXCL | _O_TEMPORARY | _O_NOINHERIT, 0600);
  });
}

int mkstemps(char* name, int suffix) {
  return with_random_name(name, static_cast<size_t>(suffix), [](const wchar_t* path) {
    return open(path, _O_RDWR | _O_CREAT | _O_EXCL | _O_NOINHERIT, 0600);
  });
}

char* mkdtemp(char* name) { return with_random_name(name, 0, ::_wmkdir) == 0 ? name : nullptr; }

ssize_t getrandom(void* to, size_t bytes, unsigned) {
  const auto size = static_cast<ULONG>(bytes);
  constexpr ULONG how = BCRYPT_USE_SYSTEM_PREFERRED_RNG;
  return ::BCryptGenRandom(nullptr, static_cast<UCHAR*>(to), size, how) == 0
             ? static_cast<ssize_t>(bytes)
             : fail(EIO);
}

int ioctl(int file, int, winsize* size) {
  CONSOLE_SCREEN_BUFFER_INFO console = {};
  if (::GetConsoleScreenBufferInfo(handle_of(file), &console) == 0) return fail(ENOTTY);
  size->ws_col = static_cast<unsigned short>(console.srWindow.Right - console.srWindow.Left + 1);
  return 0;
}

int uname(utsname* name) {
  *name = {"Windows", "", "x86_64"};
  return 0;
}

int fnmatch(const char* pattern, const char* text, int flags) {
  for (; *pattern != '\0'; ++pattern, ++text) {
    if (*pattern == '*') {
      do {
        if (fnmatch(pattern + 1, text, flags) == 0) return 0;
      } while (*text++ != '\0');
      return 1;
    }
    if (*text == '\0' || (*pattern != '?' && *pattern != *text)) return 1;
  }
  return *text == '\0' ? 0 : 1;
}

void* dlopen(const wchar_t* file, int) { return ::LoadLibraryW(file); }

void* dlsym(void* library, const char* name) {
  return reinterpret_cast<void*>(::GetProcAddress(static_cast<HMODULE>(library), name));
}

const char* dlerror() { return "Windows does not load it, or not what it needs"; }

int EVP_Digest(const void* bytes, size_t size, unsigned char* digest, unsigned* digest_size,
               const void*, void*) {
  BCRYPT_ALG_HANDLE algorithm = nullptr;
  if (::BCryptOpenAlgorithmProvider(&algorithm, BCRYPT_SHA256_ALGORITHM, nullptr, 0) != 0) return 0;
  const NTSTATUS status =
      ::BCryptHash(algorithm, nullptr, 0, static_cast<UCHAR*>(const_cast<void*>(bytes)),
                   static_cast<ULONG>(size), digest, *digest_size = 32);
  ::BCryptCloseAlgorithmProvider(algorithm, 0);
  return status == 0 ? 1 : 0;
}

int EVP_EncodeBlock(unsigned char* text, const unsigned char* bytes, int size) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  unsigned char* to = text;
  for (int at = 0; at < size; at += 3) {
    const int left = std::min(size - at, 3);
    unsigned word = 0;
    for (int i = 0; i < 3; ++i) word = word << 8 | (i < left ? bytes[at + i] : 0u);
    for (int i = 0; i < 4; ++i) {
      *to++ = static_cast<unsigned char>(i <= left ? kDigits[word >> (18 - 6 * i) & 63] : '=');
    }
  }
  *to = '\0';
  return static_cast<int>(to - text);
}
