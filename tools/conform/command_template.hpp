// Command lines with places to fill in, such as 'mydec {input} -o {output}'.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/io_error.hpp"

namespace hmlfc::conform {

/// What stands for {name} in a command line.
using Places = std::map<std::string, std::string, std::less<>>;

/// The words of `text`: separated by blanks; quotes ("..." or '...') and a backslash before a
/// character keep blanks in a word, as a shell does. Nothing else of a shell is known: no
/// variables, no pipes (use sh -c '...'). Errors: a quote without its end, no words at all.
io::IoResult<std::vector<std::string>> split_command(std::string_view text);

/// `words` with every {name} of `places` replaced; other braces stay.
std::vector<std::string> fill_in(const std::vector<std::string>& words, const Places& places);

}  // namespace hmlfc::conform
