// What this system is.
#pragma once

struct utsname {
  char sysname[16];
  char release[32];
  char machine[16];
};
int uname(utsname* name);
