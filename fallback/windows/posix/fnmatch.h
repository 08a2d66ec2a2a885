// Patterns of * and ?; 0: `text` is of one.
#pragma once

int fnmatch(const char* pattern, const char* text, int flags);
