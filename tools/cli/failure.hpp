// How a command ends when it cannot do what was asked, and the exit codes of the program.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include <hmlfc/error.hpp>

#include "io/io_error.hpp"

namespace hmlfc::cli {

/// Exit status of the process; those from 70 on are the numbers of sysexits.h.
enum class ExitCode : int {
  kDone = 0,
  kDifferent = 1,     ///< a comparison found a difference
  kUsage = 2,         ///< wrong arguments, or an output that cannot be made at the named place
  kInput = 3,         ///< an input is missing, unreadable or not acceptable
  kCorrupt = 4,       ///< a stream broke a rule of the specification
  kIncomplete = 5,    ///< nothing failed, but not all that is required was tested
  kInternal = 70,     ///< a defect of this program
  kOutOfMemory = 71,  ///< not enough memory
  kOutput = 74,       ///< writing failed: full disk, closed pipe
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

/// The failure that a decoder's error on stream `file` means.
Failure stream_failure(const std::filesystem::path& file, const Error& error);

/// The value of `result`; throws its error as a Failure with `code`.
template <class T>
T value_or_throw(io::IoResult<T> result, ExitCode code) {
  if (!result) throw Failure(code, result.error().message);
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

/// The value of `result`, decoded from stream `file`.
template <class T>
T value_or_throw(Result<T> result, const std::filesystem::path& file) {
  if (!result) throw stream_failure(file, result.error());
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

}  // namespace hmlfc::cli
