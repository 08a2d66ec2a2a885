// Signals that Windows never sends; signal() refuses them.
#pragma once

#include_next <signal.h>

#define SIGPIPE 13
#define SIGXFSZ 25
