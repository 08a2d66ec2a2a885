// hmlfc view, whose server is for POSIX: there is no such command.
#include "cli/commands.hpp"

namespace hmlfc::cli {

void add_viewer(CLI::App&, Task&) {}

}  // namespace hmlfc::cli
