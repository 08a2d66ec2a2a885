// How a command ends, and what it prints.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include <hmlfc/error.hpp>

#include "io/io_error.hpp"
#include "io/notes.hpp"

namespace hmlfc::cli {

/// Exit status of the process; those from 70 on are the numbers of sysexits.h.
enum class ExitCode : int {
  kDone = 0,
  kDifferent = 1,     ///< a comparison found a difference
  kUsage = 2,         ///< wrong arguments, or an output that cannot be created there
  kInput = 3,         ///< an input is missing, unreadable or unsuitable
  kCorrupt = 4,       ///< a stream broke a rule of the specification
  kIncomplete = 5,    ///< no failures, but required tests were skipped
  kMissed = 6,        ///< an encoding that misses its target was written
  kInternal = 70,     ///< a bug in this program
  kOutOfMemory = 71,  ///< not enough memory
  kOutput = 74,       ///< writing failed: full disk; closed pipe, without a message
  kCannotRun = 77,    ///< a decoder under test cannot run on this machine
  kNoDecoder = 126,   ///< a library cannot be loaded or is no decoder; a shell's "not executable"
};

/// Thrown by a command; main prints the message and exits with the code.
class Failure : public std::runtime_error {
 public:
  Failure(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// The failure for a decoder's error in stream `file`; what its name says of it where it is none.
Failure stream_failure(const std::filesystem::path& file, const Error& error);

/// The value of `result`; throws its error as a Failure with `code`, or kOutOfMemory.
template <class T>
T value_or_throw(io::IoResult<T> result, ExitCode code) {
  if (!result) {
    const io::IoError& error = result.error();
    throw Failure(error.out_of_memory ? ExitCode::kOutOfMemory : code, error.message);
  }
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

/// JSON whose keys keep the order in which they were set.
using Json = nlohmann::ordered_json;

/// Writes `text` to standard output, as terminal::shown() gives it. Failure (kOutput) where it
/// cannot be written.
void print(std::string_view text);

/// From now on print() writes to standard error, for standard output takes a file.
void print_to_standard_error();

/// Writes `bytes` to standard output. Failure as print().
void write_standard_output(std::span<const uint8_t> bytes);

/// Writes `json` on indented lines.
void print_json(const Json& json);

/// Writes `json` where --json asks for it, `text` elsewhere.
void print_result(bool as_json, const Json& json, std::string_view text);

/// Flushes standard output. Failure as print().
void flush_output();

/// One line for the user on standard error, in place of a progress bar there.
void note(const std::string& message);

/// The lines of `notes` as such.
void tell(const io::Notes& notes);

/// A PSNR for JSON: the number of dB, or the text "inf" for identical pictures, which JSON cannot
/// hold as a number.
Json psnr_json(double db);

/// "39.21 dB" or "inf".
std::string psnr_text(double db);

/// "1 234 567": thousands separated by spaces.
std::string grouped(uint64_t number);

}  // namespace hmlfc::cli
