// Where the program begins on Windows: arguments come as UTF-8, text goes to the terminal as UTF-8,
// and everything else byte by byte.
#include <windows.h>

#include <fcntl.h>
#include <io.h>

#include <cstdio>
#include <string>
#include <vector>

#include "names.hpp"

int hmlfc_main(int count, char** arguments);

extern "C" int wmain(int count, wchar_t** arguments) {
  for (std::FILE* file : {stdin, stdout, stderr}) ::_setmode(::_fileno(file), _O_BINARY);
  ::SetConsoleOutputCP(CP_UTF8);
  const HANDLE terminal = ::GetStdHandle(STD_ERROR_HANDLE);
  DWORD mode = 0;
  if (::GetConsoleMode(terminal, &mode) != 0) {
    ::SetConsoleMode(terminal, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
  }
  std::vector<std::string> texts;
  for (int i = 0; i < count; ++i) texts.push_back(hmlfc::windows::narrow(arguments[i]));
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return hmlfc_main(count, pointers.data());
}
