// Mapped files that another program makes shorter.
#pragma once

namespace hmlfc::terminal {

/// From now on, bytes of a mapped file that are there no longer read as zeros; without this, the
/// access would end the program (SIGBUS). For programs: a library leaves signals alone.
void survive_lost_pages();

/// Whether any such byte was read.
bool pages_were_lost();

}  // namespace hmlfc::terminal
