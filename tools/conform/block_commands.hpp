// Commands that show what a decoder gets wrong.
#pragma once

#include <string>

#include "conform/runner.hpp"

namespace hmlfc::conform {

/// `word` as a shell reads it again: "'a b'".
std::string shell_word(const std::string& word);

/// The command that prints the first wrong block of `result`, a failure, or its stream where no
/// block is known: "hmlfc inspect FILE --view 0,1 --plane Co --block 3,2".
std::string inspect_command(const Suite& suite, const vectors::Vector& vector,
                            const VectorResult& result);

/// The command that opens the same block with `dut` next to the golden model:
/// "hmlfc view FILE --dut 'NAME' --view 0,1 --plane Co --block 3,2". Without a block the
/// stream alone.
std::string view_command(const Suite& suite, const vectors::Vector& vector, const Dut& dut,
                         const VectorResult& result);

}  // namespace hmlfc::conform
