// A decoder under test (DUT): how it is run and what it claims to decode.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "dut/claims.hpp"
#include "io/io_error.hpp"

namespace hmlfc::conform {

/// The text that replaces each {name} in a command line.
using Places = std::map<std::string, std::string, std::less<>>;

/// `words` with every {name} of `places` replaced; other braces stay.
std::vector<std::string> fill_in(const std::vector<std::string>& words, const Places& places);

/// A vector that the decoder is known to fail, and why that is accepted.
struct Waiver {
  std::string vector;  ///< its id
  std::string reason;
};

class WaitingDuts;

/// How a decoder is run, and what it claims to support.
struct Dut {
  std::string name;
  std::string text;  ///< what read_dut() read it from
  /// Decodes the stream {input} into the folder {output}, which exists and is empty; with
  /// `waiting`, speaks the line protocol.
  std::vector<std::string> command;
  std::shared_ptr<WaitingDuts> waiting;  ///< its processes; null without the line protocol
  bool by_block = false;                 ///< views are put together from blocks
  /// Prints the stages of one block as JSON lines; empty if the decoder cannot. Placeholders:
  /// {input}, {view_row}, {view_col}, {plane} (0, 1, 2), {block_x}, {block_y}.
  std::vector<std::string> trace;
  /// Draws a frame of {input} into {output}; empty if the command line cannot. Placeholders:
  /// {record} or {camera}; {stop_level}, {levels}.
  std::vector<std::string> frame;
  /// Writes the disparity map of view {view_row}, {view_col} of {input} into {output}; or empty.
  std::vector<std::string> disparity;
  Claims claims;
  bool error_names = false;      ///< it names the error of annex A on standard error
  bool checks_sections = false;  ///< it checks the crc of every section (FIL-6)
  std::vector<Waiver> waivers;

  /// The waiver of vector `id`, or null.
  const Waiver* waiver(const std::string& id) const;
};

/// The decoder that `text` names:
/// - a file *.json: a declaration (docs/conformance.md has its keys);
/// - a file *.so: a library with the interface of hmlfc_dut.h, which `hmlfc serve` runs;
/// - "lines: " and a command line: a program that speaks the line protocol (docs/line_protocol.md);
/// - else a command line with {input} and {output}, and of a renderer {record} or {camera}: words
/// separated by blanks; quotes ("..." or
///   '...') and a backslash before a character keep blanks in a word, as in a shell. No other shell
///   syntax is supported: no variables, no pipes (use sh -c '...').
///
/// All may contain {hmlfc}, this program; {bin}, its folder; and {dut}, the folder of the DUT file.
/// Errors: a file that cannot be read, a key that is unknown or has a wrong value, a command with
/// an unterminated quote, or without {input} or {output}.
io::IoResult<Dut> read_dut(const std::string& text, const std::filesystem::path& hmlfc);

}  // namespace hmlfc::conform
