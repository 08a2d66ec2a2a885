// The width of the terminal.
#pragma once

struct winsize {
  unsigned short ws_col;
};

#define TIOCGWINSZ 0
int ioctl(int file, int request, winsize* size);
