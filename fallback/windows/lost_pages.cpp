// Mapped files: Windows lets nobody make them shorter.
#include "terminal/lost_pages.hpp"

namespace hmlfc::terminal {

void survive_lost_pages() {}
bool pages_were_lost() { return false; }

}  // namespace hmlfc::terminal
